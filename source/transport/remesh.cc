// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/initial_state.h>
#include <treacle/mesh/lattice_mesh.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/redistance.h>
#include <treacle/transport/bands.h>
#include <treacle/transport/octree_growth.h>
#include <treacle/transport/remesh.h>
#include <treacle/transport/time_step.h>

namespace treacle
{
  namespace
  {
    /// By how much leaves may be larger than the surface asks for before a new mesh is made, lest
    /// meshes flicker; and of what it asks for, what larger ones must be.
    constexpr double too_large = 1.25, too_small = 0.75;
    /// How often a coarser mesh is looked for, and the part of the leaves that it may have.
    constexpr unsigned int steps_between_looks = 8;
    constexpr double       worth_while         = 0.7;

    /// The surface of the liquids at t = 0 on the lattice of an octree: no mesh is needed for that.
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
    append_way_ahead(BandPoints<dim>                 &points,
                     const Mesh<dim>                 &mesh,
                     const std::vector<Point<dim>>   &now,
                     const std::vector<Point<dim>>   &next,
                     const std::vector<unsigned int> &level)
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
            points[level[i]].push_back({next[i] + way * k / n_points, {}});
        }
    }

    /// The level that each vertex of a surface asks for, with leaves that may be larger by a factor
    /// than the sizes (m) at nodes.
    template <int dim>
    std::vector<unsigned int>
    vertex_levels(const OctreeParameters<dim> &prm,
                  const Surface<dim>          &surface,
                  const Vector                &size,
                  const double                 factor)
    {
      std::vector<unsigned int> levels;
      for (const auto &vertex : surface.vertices)
        levels.push_back(std::max(prm.coarsest_at_surface(),
                                  prm.level_of(factor * std::min(size.local_element(vertex.a),
                                                                 size.local_element(vertex.b)))));
      return levels;
    }

    /// A surface after a step.
    template <int dim>
    struct NextSurface
    {
      const Mesh<dim>                &mesh;
      const Surface<dim>             &surface;
      const std::vector<Point<dim>>  &vertices; ///< of it, after the step
      const std::vector<Marker<dim>> &markers;
      const Vector                   &size; ///< that it asks for (m), at nodes

      /// With leaves that may be larger by a factor. Markers that left the surface behind are in the
      /// coarsest band.
      BandPoints<dim>
      points(const double factor) const
      {
        const OctreeParameters<dim> &prm = mesh.octree().parameters();
        BandPoints<dim>              result =
          facets_by_level(surface, vertices, vertex_levels(prm, surface, size, factor));
        for (const Marker<dim> &marker : markers)
          result[prm.coarsest_at_surface()].push_back({marker.position, {}});
        return result;
      }

      /// And where it goes on to.
      BandPoints<dim>
      points_ahead() const
      {
        BandPoints<dim> result = points(1);
        append_way_ahead(result,
                         mesh,
                         surface.positions,
                         vertices,
                         vertex_levels(mesh.octree().parameters(), surface, size, 1));
        return result;
      }
    };

    template <int dim>
    std::vector<Leaf<dim>>
    owned_leaves(const Octree<dim> &octree)
    {
      return {octree.leaves().begin(), octree.leaves().begin() + octree.n_owned_leaves()};
    }

    /// On all ranks. Collective.
    template <int dim>
    double
    n_leaves(const Octree<dim> &octree)
    {
      return Utilities::MPI::sum(1. * octree.n_owned_leaves(), octree.communicator());
    }

    /// Would half of the cells along the surface do, where it has sizes? Collective.
    template <int dim>
    bool
    is_too_fine(const Mesh<dim> &mesh, const Vector &size)
    {
      const OctreeParameters<dim> &prm = mesh.octree().parameters();
      Tensor<1, 2> count; // of nodes at the surface, and of those that it asks for
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (const double s = size.local_element(node); s > 0)
          {
            const double asked = prm.size_of(prm.level_of(too_small * s));
            count[0] += 1;
            count[1] += std::pow(std::min(1., surface_size_at_node(mesh, node) / asked), dim - 1);
          }
      count = Utilities::MPI::sum(count, mesh.communicator());
      return count[1] < 0.5 * count[0];
    }
  } // namespace

  namespace
  {
    /// Leaves that distances say the surface is in, to a level where their corners show it. Something
    /// small may hide between corners all on one side.
    template <int dim>
    typename Octree<dim>::Criterion
    around_distances(const OctreeParameters<dim> &prm, const Scene<dim> &scene)
    {
      return [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<bool> near;
        for (const Leaf<dim> &leaf : leaves)
          {
            const double distance = scene.liquid_distance(centre<dim>(prm, leaf));
            bool         refine   = is_within(prm, leaf, distance, prm.finest_size());
            if (refine && leaf.level >= prm.coarsest_at_surface())
              for (unsigned int corner = 0; corner < 1u << dim && refine; ++corner)
                refine = (scene.liquid_distance(vertex_of_cube<dim>(
                            centre<dim>(prm, leaf), prm.size_of(leaf.level), corner)) < 0) ==
                         (distance < 0);
            near.push_back(refine);
          }
        return near;
      };
    }

    /// Refines where the surface on the mesh before asks for it, until it asks for no more: not
    /// everywhere to the finest level first, which no memory may hold.
    template <int dim>
    std::shared_ptr<const Mesh<dim>>
    mesh_by_sizes(std::shared_ptr<const Octree<dim>> octree,
                  const Sizing<dim>                 &sizing,
                  const OctreeGrowth<dim>           &growth,
                  const Scene<dim>                  &scene)
    {
      const OctreeParameters<dim> prm = octree->parameters();
      for (unsigned int level = prm.coarsest_at_surface();; ++level)
        {
          const auto mesh = std::make_shared<const Mesh<dim>>(octree);
          if (level == prm.surface_level + 2)
            return mesh;
          State<dim> state(mesh);
          set_initial_level_set(state, scene);
          redistance(state, TimeStep<dim>::reach_of_distance(0, *mesh));
          const SurfaceGeometry<dim> surface(mesh, state.phi);
          const Vector               size = sizing.at_surface(state, surface);
          const Bands<dim>           bands(*octree,
                                 scene,
                                 0.,
                                 facets_by_level(surface.facets,
                                                 surface.facets.positions,
                                                 vertex_levels(prm, surface.facets, size, 1)),
                                 false);
          if (level > prm.coarsest_at_surface() && bands.are_in_leaves())
            return mesh;
          octree = growth.grow([&](const auto &leaves) { return bands.touch(leaves); });
        }
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  initial_mesh(const MPI_Comm                         &comm,
               const typename Octree<dim>::Parameters &prm,
               const Scene<dim>                       &scene)
  {
    const Sizing<dim>       sizing(prm, scene);
    const OctreeGrowth<dim> growth(comm, prm, sizing, 0., [&](const std::vector<Point<dim>> &x) {
      std::vector<double> values;
      values.reserve(x.size());
      for (const Point<dim> &p : x)
        values.push_back(scene.liquid_distance(p));
      return values;
    });
    // first where the distance is small, then around what was found: an
    // expression need not be a distance
    const auto octree = growth.grow(around_distances(prm, scene));
    if (!sizing.is_uniform_at_surface())
      return mesh_by_sizes(octree, sizing, growth, scene);
    const Bands<dim> bands(
      *octree, scene, 0., {{prm.surface_level, initial_surface<dim>(octree, scene)}}, false);
    return std::make_shared<const Mesh<dim>>(
      growth.grow([&](const auto &leaves) { return bands.touch(leaves); }));
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
    const Octree<dim>           &octree = mesh.octree();
    const OctreeParameters<dim> &prm    = octree.parameters();
    const double                 time   = state.time + dt;
    const Sizing<dim>            sizing(prm, scene);
    const OctreeGrowth<dim>      growth(
      mesh.communicator(), prm, sizing, time, [&](const std::vector<Point<dim>> &x) {
        std::vector<double> phi = advection.level_set(x);
        for (unsigned int i = 0; i < x.size(); ++i)
          phi[i] = std::min(phi[i], scene.emitter_distance(x[i], time));
        return phi;
      });
    const Vector size = sizing.is_uniform_at_surface() ? mesh.zeros(mesh.nodes) :
                                                         sizing.at_surface(state, surface);
    const NextSurface<dim> moved{mesh, surface.facets, next, markers, size};
    const bool             is_fine_enough =
      Bands<dim>(octree, scene, time, moved.points(too_large), true).are_in_leaves() &&
      !(sizing.asks_in_liquid() && growth.is_any_too_coarse(owned_leaves(octree)));
    if (is_fine_enough && (state.step % steps_between_looks != 0 || !is_too_fine(mesh, size)))
      return state.mesh;
    const Bands<dim> bands(octree, scene, time, moved.points_ahead(), false);
    const auto       tree = growth.grow([&](const auto &leaves) { return bands.touch(leaves); });
    return is_fine_enough && n_leaves(*tree) > worth_while * n_leaves(octree) ?
             state.mesh :
             std::make_shared<const Mesh<dim>>(tree);
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
