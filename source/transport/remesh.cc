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

    /// A facet's corners and centre, with its normal, are what a band is laid around.
    template <int dim>
    void
    append(std::vector<BandPoint<dim>> &points, const std::array<Point<dim>, dim> &facet)
    {
      Tensor<1, dim> normal = area_vector<dim>(facet);
      if (const double area = normal.norm(); area > 0)
        normal /= area;
      Point<dim> centre;
      for (const Point<dim> &x : facet)
        {
          points.push_back({x, normal});
          centre += x / dim;
        }
      points.push_back({centre, normal});
    }

    /// Those of the liquids at t = 0 on the lattice of an octree: no mesh is needed for that.
    template <int dim>
    std::vector<BandPoint<dim>>
    initial_surface(const std::shared_ptr<const Octree<dim>> &octree, const Scene<dim> &scene)
    {
      const MeshCells<dim> mesh = LatticeMesh<dim>(octree).take_cells();
      const unsigned int   rank = Utilities::MPI::this_mpi_process(octree->communicator());
      std::vector<double>  phi;
      for (const auto &vertex : mesh.vertices)
        phi.push_back(scene.liquid_distance(vertex.position));
      std::vector<BandPoint<dim>> points;
      for (const auto &cell : mesh.cells)
        {
          VertexValues<dim> values;
          for (unsigned int v = 0; v <= dim; ++v)
            values[v] = phi[cell.vertex[v]];
          const Facets<dim> facets = surface_facets<dim>(values);
          for (unsigned int k = 0; k < facets.n && cell.owner == rank; ++k)
            append<dim>(
              points,
              facet_points<dim>(facets.facet[k], values, [&](const unsigned int v) -> const Point<dim> & {
                return mesh.vertices[cell.vertex[v]].position;
              }));
        }
      return points;
    }

    /// The places that the vertices of the surface would pass in the steps after the next, so
    /// that a new mesh serves for some: at s leaves a step for 3 / sqrt(s) steps. A mesh costs
    /// about as much as a step, (1 + 1/n) (A + B n s) for each of n, and B is about A/9.
    template <int dim>
    void
    append_way_ahead(std::vector<BandPoint<dim>>   &points,
                     const Mesh<dim>               &mesh,
                     const std::vector<Point<dim>> &now,
                     const std::vector<Point<dim>> &next)
    {
      double furthest = 0;
      for (unsigned int i = 0; i < now.size(); ++i)
        furthest = std::max(furthest, now[i].distance(next[i]));
      const double h = mesh.finest_size();
      const double s = Utilities::MPI::max(furthest, mesh.communicator()) / h;
      if (s == 0 || s > 9)
        return;
      const double n_steps = 3 / std::sqrt(s);
      for (unsigned int i = 0; i < now.size(); ++i)
        {
          const Tensor<1, dim> way      = n_steps * (next[i] - now[i]);
          const unsigned int   n_points = std::ceil(way.norm() / h);
          for (unsigned int k = 1; k <= n_points; ++k)
            points.push_back({next[i] + way * k / n_points, {}});
        }
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

    template <int dim>
    BandWidths
    widths(const OctreeParameters<dim> &prm)
    {
      return {prm.band_width + 1., prm.air_band_width + 0.5};
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

    /// Do finest leaves make a difference there? Not in solids from a leaf or two on; only
    /// signs tell, for the distance of an expression need not be one.
    template <int dim>
    std::function<bool(const Point<dim> &)>
    outside_solids(const Scene<dim> &scene, const double h, const double time)
    {
      if (!scene.has_solids())
        return [](const Point<dim> &) { return true; };
      return [&scene, h, time](const Point<dim> &x) {
        bool is_open = scene.solid_distance(x, time) >= 0;
        for (unsigned int k = 0; k < 2 * dim && !is_open; ++k)
          {
            Point<dim> aside = x;
            aside[k / 2] += k % 2 == 0 ? 2 * h : -2 * h;
            is_open = scene.solid_distance(aside, time) >= 0;
          }
        return is_open;
      };
    }

    /// What leaves cost with phi at their centres, in microseconds of a step: the liquid, and more
    /// where the surface cuts it, the air little.
    template <int dim>
    std::vector<unsigned int>
    costs(const typename Octree<dim>::Parameters &prm,
          const std::vector<Leaf<dim>>           &leaves,
          const std::vector<double>              &phi)
    {
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < leaves.size(); ++i)
        result.push_back((phi[i] < 0 ? 14 : 3) + (is_within(prm, leaves[i], phi[i], 0.) ? 10 : 0));
      return result;
    }

    /// Refine where @p is_near says, inside the liquid to the interior level and
    /// everywhere to the air level; every rank has about the same work with it.
    template <int dim>
    std::shared_ptr<const Octree<dim>>
    grow(const MPI_Comm                         &comm,
         const typename Octree<dim>::Parameters &prm,
         const std::function<std::vector<bool>(const std::vector<Leaf<dim>> &)> &is_near,
         const LevelSet<dim>                                                    &phi)
    {
      const auto phi_at_centres = [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<Point<dim>> x;
        for (const Leaf<dim> &leaf : leaves)
          x.push_back(centre<dim>(prm, leaf));
        return phi(x);
      };
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
          const std::vector<double> values = phi_at_centres(leaves);
          for (unsigned int i = 0; i < leaves.size(); ++i)
            refine[i] = refine[i] || values[i] < 0;
          return refine;
        },
        [&](const std::vector<Leaf<dim>> &leaves) {
          return costs<dim>(prm, leaves, phi_at_centres(leaves));
        });
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
      values.reserve(x.size());
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
    const Band<dim> band(*octree,
                         initial_surface<dim>(octree, scene),
                         widths(prm),
                         outside_solids(scene, prm.finest_size(), 0.));
    return std::make_shared<const Mesh<dim>>(grow<dim>(
      comm, prm, [&](const auto &leaves) { return near_surface(band, prm, scene, 0., leaves); }, phi));
  }

  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  mesh_for_next_surface(const State<dim>               &state,
                        const Scene<dim>               &scene,
                        const SurfaceGeometry<dim>     &surface,
                        const Advection<dim>           &advection,
                        const std::vector<Point<dim>>  &next,
                        const std::vector<Marker<dim>> &markers,
                        const double                    dt)
  {
    const Mesh<dim> &mesh = *state.mesh;
    if (!mesh.is_lattice())
      return state.mesh;
    const Octree<dim>            &octree  = mesh.octree();
    const auto is_needed = outside_solids(scene, mesh.finest_size(), state.time + dt);
    std::vector<BandPoint<dim>>   points;
    for (unsigned int k = 0; k < surface.facets.facets.size(); ++k)
      append<dim>(points, surface.facets.facet_points(k, next));
    for (const Marker<dim> &marker : markers)
      points.push_back({marker.position, {}});
    if (Band<dim>(octree, points, {}, is_needed).is_finest_in(octree))
      return state.mesh;
    append_way_ahead(points, mesh, surface.facets.positions, next);
    const Band<dim> band(octree, points, widths(octree.parameters()), is_needed);
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
    const std::vector<Point<dim>> &,                                            \
    const std::vector<Marker<dim>> &,                                           \
    const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
