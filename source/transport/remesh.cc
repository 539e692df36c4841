// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/carried_in_cell.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/transport/bands.h>
#include <treacle/transport/octree_growth.h>
#include <treacle/transport/remesh.h>
#include <treacle/transport/velocity_error.h>

namespace treacle
{
  namespace
  {
    /// By how much leaves may be larger than the surface asks for before a new mesh is made, lest
    /// meshes flicker.
    constexpr double too_large = 1.25;
    /// The same where Maximum cells makes them larger by a factor: such a mesh is looked at again in a few steps, and on
    /// coarse leaves a surface asks for others than it did on the fine ones before.
    constexpr double too_large_if_bounded = 2;
    /// Of all leaves, those that may be too large within a leaf of the surface before a new mesh is made,
    /// as where it went on as nobody expected. Where the surface is, they never are.
    constexpr double most_missing = 0.002;
    /// How often a coarser mesh is looked for, and the part of the leaves that it may have; how often another one, of any size,
    /// where there is such a factor.
    constexpr unsigned int steps_between_looks = 8, steps_if_bounded = 4;
    constexpr double       worth_while         = 0.7;

    /// The factor by which a bound makes leaves larger; 1 without one, whatever the octree was made with.
    template <int dim>
    double
    factor_of_bound(const Octree<dim> &octree)
    {
      return octree.parameters().maximum_cells > 0 ? octree.size_factor() : 1.;
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
      const auto size     = [&](const unsigned int i) { return mesh.octree().parameters().size_of(level[i]); };
      double     furthest = 0;
      for (unsigned int i = 0; i < now.size(); ++i)
        furthest = std::max(furthest, now[i].distance(next[i]) / size(i));
      const double s = Utilities::MPI::max(furthest, mesh.communicator());
      if (s == 0 || s > 9)
        return;
      const double n_steps = 3 / std::sqrt(s);
      for (unsigned int i = 0; i < now.size(); ++i)
        {
          const Tensor<1, dim> way      = n_steps * (next[i] - now[i]);
          const unsigned int   n_points = std::ceil(way.norm() / size(i));
          for (unsigned int k = 1; k <= n_points; ++k)
            points[level[i]].push_back({next[i] + way * k / n_points, {}});
        }
    }

    /// A place (m) after a step, and the way there.
    template <int dim>
    struct Jump
    {
      Point<dim>     x;
      Tensor<1, dim> way;
    };

    /// Where the material that the liquid carries jumps after a step, if there are to be fine leaves:
    /// centroids of cells.
    template <int dim>
    std::vector<Jump<dim>>
    jumps_after(const State<dim> &state, const double dt)
    {
      const Mesh<dim>       &mesh = *state.mesh;
      std::vector<Jump<dim>> result;
      if (!state.material || !mesh.octree().parameters().fine_at_jumps)
        return result;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        {
          const VertexValues<dim>  phi = mesh.values(c, state.phi);
          const CarriedInCell<dim> density(mesh, state.material->density, c),
            viscosity(mesh, state.material->viscosity, c);
          if (*std::min_element(phi.begin(), phi.end()) >= 0 || !(density.jumps() || viscosity.jumps()))
            continue;
          Point<dim>     x;
          Tensor<1, dim> way;
          for (const LocalIndex node : mesh.cell_nodes[c])
            {
              x += mesh.node_position[node] / (dim + 1);
              way += dt * state.v.value(node) / (dim + 1);
            }
          result.push_back({x + way, way});
        }
      return result;
    }

    /// A surface after a step.
    template <int dim>
    struct NextSurface
    {
      const Mesh<dim>                &mesh;
      const Surface<dim>             &surface;
      const std::vector<Point<dim>>  &vertices; ///< of it, after the step
      const std::vector<Marker<dim>> &markers;
      const std::vector<Jump<dim>>   &jumps; ///< of the material that is carried along
      const std::vector<AskedSize<dim>> &inside; ///< what the velocity asks for
      const Vector                   &size;  ///< that it asks for (m), at nodes

      /// Are leaves as fine as it asks for and a bound allows, or nearly so, but for a few beside it? Collective.
      bool
      is_in_leaves_of(const Octree<dim> &octree, const Scene<dim> &scene, const double time) const
      {
        const double    factor = factor_of_bound(octree);
        BandPoints<dim> points = points_at(levels(factor * (factor > 1 ? too_large_if_bounded : too_large)));
        append_inside(points, too_large);
        return Bands<dim>(octree, scene, time, points, true).are_in_leaves(most_missing * n_leaves(octree));
      }

      /// What to lay a mesh around, with leaves that may be larger by a factor: it, and where it goes on to.
      BandPoints<dim>
      points_ahead(const double factor) const
      {
        const std::vector<unsigned int> level  = levels(factor);
        BandPoints<dim>                 result = points_at(level);
        append_way_ahead(result, mesh, surface.positions, vertices, level);
        append_around_jumps(result);
        append_inside(result, 1); // what is asked for in the liquid is not made coarser
        return result;
      }

    private:
      void
      append_inside(BandPoints<dim> &points, const double factor) const
      {
        const OctreeParameters<dim> &prm = mesh.octree().parameters();
        for (const auto &[x, asked] : inside)
          if (const unsigned int level = prm.level_of(factor * asked); level > prm.interior_level)
            points[level].push_back({x, {}});
      }

      /// Two leaves about, and the way of the next steps, so that a new mesh serves for some.
      void
      append_around_jumps(BandPoints<dim> &points) const
      {
        const OctreeParameters<dim> &prm = mesh.octree().parameters();
        const double                 h   = prm.finest_size();
        for (const Jump<dim> &jump : jumps)
          {
            const unsigned int n_ahead = std::min(3., std::ceil(4 * jump.way.norm() / h));
            for (unsigned int k = 1; k <= n_ahead; ++k)
              points[prm.surface_level].push_back({jump.x + k * (4. / n_ahead) * jump.way, {}});
            for (unsigned int d = 0; d < dim; ++d)
              for (const double side : {-2., 2.})
                {
                  Point<dim> aside = jump.x;
                  aside[d] += side * h;
                  points[prm.surface_level].push_back({aside, {}});
                }
          }
      }

      std::vector<unsigned int>
      levels(const double factor) const
      {
        return vertex_levels(mesh.octree().parameters(), surface, size, factor);
      }

      /// Markers that left the surface behind are in the coarsest band.
      BandPoints<dim>
      points_at(const std::vector<unsigned int> &level) const
      {
        BandPoints<dim> result = facets_by_level(surface, vertices, level);
        for (const Marker<dim> &marker : markers)
          result[mesh.octree().parameters().coarsest_at_surface()].push_back({marker.position, {}});
        for (const Jump<dim> &jump : jumps)
          result[mesh.octree().parameters().surface_level].push_back({jump.x, {}});
        return result;
      }
    };

    template <int dim>
    std::vector<Leaf<dim>>
    owned_leaves(const Octree<dim> &octree)
    {
      return {octree.leaves().begin(), octree.leaves().begin() + octree.n_owned_leaves()};
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  mesh_for_next_surface(const State<dim>               &state,
                        const LiquidDomain<dim>        &domain,
                        const SurfaceGeometry<dim>     &surface,
                        const Advection<dim>           &advection,
                        const std::vector<Point<dim>>  &next,
                        const std::vector<Marker<dim>> &markers,
                        const double                    dt)
  {
    const Mesh<dim> &mesh = *state.mesh;
    if (!mesh.is_lattice())
      return state.mesh;
    const Scene<dim>            &scene  = domain.scene;
    const Octree<dim>           &octree = mesh.octree();
    const OctreeParameters<dim> &prm    = octree.parameters();
    const double                 time   = state.time + dt;
    const Sizing<dim>            sizing(prm, scene);
    const OctreeGrowth<dim>      growth(
      mesh.communicator(), prm, sizing, scene, time, [&](const std::vector<Point<dim>> &x) {
        std::vector<double> phi = advection.feet(x).phi;
        for (unsigned int i = 0; i < x.size(); ++i)
          phi[i] = std::min(phi[i], scene.emitter_distance(x[i], time));
        return phi;
      });
    const Vector size = sizing.at_surface(state, surface);
    const bool             is_bounded = factor_of_bound(octree) > 1;
    const auto             jumps      = jumps_after(state, dt);
    const auto             inside     = sizes_by_velocity(state, domain, dt);
    const NextSurface<dim> moved{mesh, surface.facets, next, markers, jumps, inside, size};
    const bool is_fine_enough =
      moved.is_in_leaves_of(octree, scene, time) &&
      !(growth.may_be_too_coarse() && growth.is_any_too_coarse(owned_leaves(octree)));
    const bool is_time_to_look =
      state.step > 0 && (is_bounded ? state.step % steps_if_bounded == 0 :
                                      state.step % steps_between_looks == 0 &&
                                        (prm.velocity_error > 0 || is_too_fine(mesh, size)));
    if (is_fine_enough && !is_time_to_look)
      return state.mesh;
    const auto tree =
      growth.grow_around(octree, [&](const double factor) { return moved.points_ahead(factor); });
    return (is_fine_enough && !is_bounded && n_leaves(*tree) > worth_while * n_leaves(octree)) ||
               fingerprint(*tree) == fingerprint(octree) ?
             state.mesh :
             std::make_shared<const Mesh<dim>>(tree);
  }

#define INSTANTIATE(dim)                                                        \
  template std::shared_ptr<const Mesh<dim>> mesh_for_next_surface(              \
    const State<dim> &,                                                         \
    const LiquidDomain<dim> &,                                                  \
    const SurfaceGeometry<dim> &,                                               \
    const Advection<dim> &,                                                     \
    const std::vector<Point<dim>> &,                                            \
    const std::vector<Marker<dim>> &,                                           \
    const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
