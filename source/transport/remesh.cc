// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/lattice_mesh.h>
#include <treacle/surface/surface.h>
#include <treacle/transport/remesh.h>

namespace treacle
{
  namespace
  {
    /// phi at any points, collectively.
    template <int dim>
    using LevelSet = std::function<std::vector<double>(const std::vector<Point<dim>> &)>;

    /// The corners and centres of facets: what a band is laid around.
    template <int dim>
    std::vector<Point<dim>>
    sample_points(const Surface<dim> &surface)
    {
      std::vector<Point<dim>> x = surface.positions;
      for (unsigned int k = 0; k < surface.facets.size(); ++k)
        {
          Point<dim> centre;
          for (const Point<dim> &p : surface.facet_points(k))
            centre += p / dim;
          x.push_back(centre);
        }
      return x;
    }

    /// The same of the liquids at t = 0 on the lattice of an octree: no mesh is needed for that.
    template <int dim>
    std::vector<Point<dim>>
    sample_points(const std::shared_ptr<const Octree<dim>> &octree, const Scene<dim> &scene)
    {
      const MeshCells<dim> mesh = LatticeMesh<dim>(octree).take_cells();
      const unsigned int   rank = Utilities::MPI::this_mpi_process(octree->communicator());
      std::vector<double>  phi;
      for (const auto &vertex : mesh.vertices)
        phi.push_back(scene.liquid_distance(vertex.position));
      std::vector<Point<dim>> x;
      for (const auto &cell : mesh.cells)
        {
          VertexValues<dim> values;
          for (unsigned int v = 0; v <= dim; ++v)
            values[v] = phi[cell.vertex[v]];
          const Facets<dim> facets = surface_facets<dim>(values);
          for (unsigned int k = 0; k < facets.n && cell.owner == rank; ++k)
            {
              Point<dim> centre;
              for (const auto &[a, b] : facets.facet[k])
                {
                  const Point<dim> &from = mesh.vertices[cell.vertex[a]].position;
                  const Point<dim> &to   = mesh.vertices[cell.vertex[b]].position;
                  x.push_back(from + edge_zero(values[a], values[b]) * (to - from));
                  centre += x.back() / dim;
                }
              x.push_back(centre);
            }
        }
      return x;
    }

    /// Centre of a leaf of an octree that is still growing.
    template <int dim>
    Point<dim>
    centre(const typename Octree<dim>::Parameters &prm, const Leaf<dim> &leaf)
    {
      Point<dim> x = prm.lower_corner;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += 0.5 * prm.finest_size() * leaf.centre()[d];
      return x;
    }

    /// Is a leaf of an octree that is still growing within @p margin (m) of where a
    /// distance vanishes?
    template <int dim>
    bool
    is_within(const typename Octree<dim>::Parameters &prm,
              const Leaf<dim>                        &leaf,
              const double                            distance,
              const double                            margin)
    {
      const double half_diagonal = 0.25 * std::sqrt(1. * dim) * prm.finest_size() * leaf.size;
      return std::abs(distance) < half_diagonal + margin;
    }

    /// Leaves that the band touches, or that are as near to an emitter.
    template <int dim>
    std::vector<bool>
    near_surface(const Band<dim>                        &band,
                 const typename Octree<dim>::Parameters &prm,
                 const Scene<dim>                       &scene,
                 const double                            time,
                 const std::vector<Leaf<dim>>           &leaves)
    {
      std::vector<bool> result = band.touches(leaves);
      if (!scene.emitters().empty())
        for (unsigned int i = 0; i < leaves.size(); ++i)
          result[i] =
            result[i] ||
            is_within(prm,
                      leaves[i],
                      scene.distance_to_emitter_boundary(centre<dim>(prm, leaves[i]), time),
                      prm.band_width * prm.finest_size());
      return result;
    }

    /// Refine where @p is_near says, inside the liquid to the interior level and
    /// everywhere to the air level.
    template <int dim>
    std::shared_ptr<const Octree<dim>>
    grow(const MPI_Comm                         &comm,
         const typename Octree<dim>::Parameters &prm,
         const std::function<std::vector<bool>(const std::vector<Leaf<dim>> &)> &is_near,
         const LevelSet<dim>                                                    &phi)
    {
      return std::make_shared<const Octree<dim>>(
        comm,
        prm,
        [&](const std::vector<Leaf<dim>> &leaves) {
          std::vector<bool> refine = is_near(leaves);
          // ranks without leaves of this level do not know it
          const unsigned int level =
            Utilities::MPI::max(leaves.empty() ? 0u : leaves.front().level, comm);
          if (level < prm.air_level)
            return std::vector<bool>(leaves.size(), true);
          if (level >= prm.interior_level)
            return refine;
          std::vector<Point<dim>> x;
          for (const Leaf<dim> &leaf : leaves)
            x.push_back(centre<dim>(prm, leaf));
          const std::vector<double> values = phi(x);
          for (unsigned int i = 0; i < leaves.size(); ++i)
            refine[i] = refine[i] || values[i] < 0;
          return refine;
        },
        &leaf_weight<dim>);
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  initial_mesh(const MPI_Comm                         &comm,
               const typename Octree<dim>::Parameters &prm,
               const Scene<dim>                       &scene)
  {
    const LevelSet<dim> phi = [&](const std::vector<Point<dim>> &x) {
      std::vector<double> values;
      for (const Point<dim> &p : x)
        values.push_back(scene.liquid_distance(p));
      return values;
    };
    // first where the distance is small, then around what was found: an
    // expression need not be a distance
    const auto octree = grow<dim>(
      comm,
      prm,
      [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<bool> near;
        for (const Leaf<dim> &leaf : leaves)
          near.push_back(is_within(prm,
                                   leaf,
                                   scene.liquid_distance(centre<dim>(prm, leaf)),
                                   prm.finest_size()));
        return near;
      },
      phi);
    const Band<dim> band(*octree, sample_points<dim>(octree, scene), prm.band_width);
    return std::make_shared<const Mesh<dim>>(grow<dim>(
      comm, prm, [&](const auto &leaves) { return near_surface(band, prm, scene, 0., leaves); }, phi));
  }

  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  mesh_for_next_surface(const State<dim>               &state,
                        const Scene<dim>               &scene,
                        const SurfaceGeometry<dim>     &surface,
                        const Advection<dim>           &advection,
                        const std::vector<Marker<dim>> &markers,
                        const double                    dt)
  {
    const Mesh<dim> &mesh = *state.mesh;
    if (!mesh.is_lattice())
      return state.mesh;
    const Octree<dim>            &octree = mesh.octree();
    std::vector<Point<dim>> moved =
      advection.move_surface(sample_points(surface.facets));
    for (const Marker<dim> &marker : markers)
      moved.push_back(marker.position);
    if (Band<dim>(octree, moved, 1).is_finest_in(octree))
      return state.mesh;
    const Band<dim> band(octree, moved, octree.parameters().band_width);
    return std::make_shared<const Mesh<dim>>(grow<dim>(
      mesh.communicator(),
      octree.parameters(),
      [&](const auto &leaves) {
        return near_surface(band, octree.parameters(), scene, state.time + dt, leaves);
      },
      [&](const std::vector<Point<dim>> &x) {
        std::vector<double> phi = advection.level_set(x);
        for (unsigned int i = 0; i < x.size(); ++i)
          phi[i] = std::min(phi[i], scene.emitter_distance(x[i], state.time + dt));
        return phi;
      }));
  }

#define INSTANTIATE(dim)                                                        \
  template std::shared_ptr<const Mesh<dim>> initial_mesh(                       \
    const MPI_Comm &, const Octree<dim>::Parameters &, const Scene<dim> &);     \
  template std::shared_ptr<const Mesh<dim>> mesh_for_next_surface(              \
    const State<dim> &,                                                         \
    const Scene<dim> &,                                                         \
    const SurfaceGeometry<dim> &,                                               \
    const Advection<dim> &,                                                     \
    const std::vector<Marker<dim>> &,                                           \
    const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
