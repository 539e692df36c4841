// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/initial_state.h>
#include <treacle/mesh/lattice_mesh.h>
#include <treacle/surface/redistance.h>
#include <treacle/transport/initial_mesh.h>
#include <treacle/transport/octree_growth.h>
#include <treacle/transport/time_step.h>

namespace treacle
{
  namespace
  {
    /// The surface of the liquids at t = 0 on the lattice of an octree: no mesh is needed for that.
    template <int dim>
    std::vector<BandPoint<dim>>
    initial_surface(const std::shared_ptr<const Octree<dim>> &octree, const Scene<dim> &scene)
    {
      const MeshCells<dim> mesh = LatticeMesh<dim>(octree).take_cells();
      const unsigned int   rank = Utilities::MPI::this_mpi_process(octree->communicator());
      const Distance<dim>  distance = initial_distance(scene, true, octree->parameters().finest_size());
      std::vector<double>  phi;
      std::string          error;
      keep_error(error, [&] {
        for (const auto &vertex : mesh.vertices)
          phi.push_back(distance(vertex.position));
      });
      throw_first(octree->communicator(), error);
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

    /// The points, and where those of surfaces that look down would be when they have fallen by some
    /// leaves: the way ahead of what begins at rest. Throws on all ranks alike. Collective.
    template <int dim>
    BandPoints<dim>
    with_way_down(const MPI_Comm              &comm,
                  const OctreeParameters<dim> &prm,
                  const Scene<dim>            &scene,
                  BandPoints<dim>              points)
    {
      constexpr unsigned int n_leaves = 2;
      constexpr double       steep    = 0.3; // cosine
      const BoundingBox<dim> box({prm.lower_corner, prm.upper_corner});
      std::string            error;
      keep_error(error, [&] {
        for (auto &[level, of_level] : points)
          for (unsigned int i = 0, n = of_level.size(); i < n; ++i)
            {
              const BandPoint<dim> point = of_level[i];
              Tensor<1, dim>       down  = scene.gravity(point.position, 0.);
              if (!(point.outward * down > steep * down.norm()))
                continue;
              down *= prm.size_of(level) / down.norm();
              for (unsigned int k = 1; k <= n_leaves; ++k)
                if (const Point<dim> x = point.position + k * down;
                    box.point_inside(x) && !scene.is_in_solids(x, 0.))
                  of_level.push_back({x, {}});
            }
      });
      throw_first(comm, error);
      return points;
    }

    /// Is a distance far from linear in a cube? What is smaller than it may hide there then, between
    /// vertices all on one side.
    template <int dim>
    bool
    may_hide_something(const Scene<dim> &scene, const Point<dim> &centre, const double in_middle, const double edge)
    {
      constexpr double   largest_part = 0.1; // of the edge
      constexpr double   wider        = 1.5; // to see a sheet that lies between two
      const unsigned int last         = (1u << dim) - 1;
      for (unsigned int i = 0; 2 * i < last; ++i)
        if (const double mean = 0.5 * (scene.liquid_distance(vertex_of_cube(centre, wider * edge, i)) +
                                       scene.liquid_distance(vertex_of_cube(centre, wider * edge, last - i)));
            std::abs(mean - in_middle) > largest_part * edge)
          return true;
      return false;
    }

    /// Is there a surface in a cube whose vertices are all on one side? A plane so near its middle would
    /// part them.
    template <int dim>
    bool
    hides_surface(const Scene<dim> &scene, const Point<dim> &centre, const double in_middle, const double edge)
    {
      if (std::abs(in_middle) >= 0.5 * edge)
        return false;
      for (unsigned int i = 0; i < 1u << dim; ++i)
        if ((scene.liquid_distance(vertex_of_cube(centre, edge, i)) < 0) != (in_middle < 0))
          return false;
      return true;
    }

    /// Leaves that distances say the surface is in, to a level that shows it; where these would be more than
    /// Maximum cells allows only those that hide it: bands around what is found go on.
    template <int dim>
    typename Octree<dim>::Criterion
    around_distances(const MPI_Comm              &comm,
                     const OctreeParameters<dim> &prm,
                     const Scene<dim>            &scene,
                     const OctreeGrowth<dim>     &growth)
    {
      return [&, n_leaves = 0.](const std::vector<Leaf<dim>> &leaves) mutable {
        constexpr double          n_more = (1u << dim) - 1;
        const std::vector<double> phi    = growth.phi_at_centres(leaves);
        std::vector<bool>         near;
        double                    n_near = 0;
        for (unsigned int i = 0; i < leaves.size(); ++i)
          {
            const Leaf<dim> &leaf = leaves[i];
            near.push_back(
              is_within(prm, leaf, phi[i], prm.finest_size()) &&
              (leaf.level < prm.coarsest_at_surface() ||
               may_hide_something(scene, centre<dim>(prm, leaf), phi[i], prm.size_of(leaf.level))));
            n_near += near.back();
          }
        const double n_with = n_leaves + n_more * Utilities::MPI::sum(n_near, comm);
        if (prm.maximum_cells > 0 && prm.n_cells(n_with) > prm.maximum_cells)
          {
            n_near = 0;
            for (unsigned int i = 0; i < leaves.size(); ++i)
              {
                near[i] = near[i] && hides_surface(scene, centre<dim>(prm, leaves[i]), phi[i], prm.size_of(leaves[i].level));
                n_near += near[i];
              }
            n_leaves += n_more * Utilities::MPI::sum(n_near, comm);
          }
        else
          n_leaves = n_with;
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
      const OctreeParameters<dim>           prm = octree->parameters();
      std::unordered_map<VertexKey, double> distances;
      // each mesh shows where the next one is to be finer by a level; with a bound the last ones would only differ in
      // what little is left over
      const unsigned int last = prm.surface_level + (prm.maximum_cells > 0 ? 0 : 2);
      for (unsigned int level = prm.coarsest_at_surface();; ++level)
        {
          const auto mesh = std::make_shared<const Mesh<dim>>(octree);
          if (level == last)
            return mesh;
          State<dim> state(mesh);
          set_initial_level_set(state, scene, distances);
          redistance(state, TimeStep<dim>::reach_of_distance(0, *mesh));
          const SurfaceGeometry<dim> surface(mesh, state.phi);
          const Vector               size = sizing.at_surface(state, surface);
          const auto                 points = [&](const double factor) {
            return with_way_down(mesh->communicator(), prm, scene,
                                 facets_by_level(surface.facets,
                                                 surface.facets.positions,
                                                 vertex_levels(prm, surface.facets, size, factor)));
          };
          if (level > prm.coarsest_at_surface() && !growth.is_full(*octree) && !is_too_fine(*mesh, size) &&
              Bands<dim>(*octree, scene, 0., points(1), false).are_in_leaves())
            return mesh;
          const auto finer = growth.grow_around(*octree, points);
          if (fingerprint(*finer) == fingerprint(*octree))
            return std::make_shared<const Mesh<dim>>(finer);
          octree = finer;
        }
    }
  } // namespace

  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  initial_mesh(const MPI_Comm                         &comm,
               const typename Octree<dim>::Parameters &parameters,
               const Scene<dim>                       &scene)
  {
    const auto              prm = with_box(parameters, scene);
    const Sizing<dim>       sizing(prm, scene);
    const OctreeGrowth<dim> growth(comm, prm, sizing, scene, 0., [&](const std::vector<Point<dim>> &x) {
      std::vector<double> values;
      values.reserve(x.size());
      for (const Point<dim> &p : x)
        values.push_back(scene.liquid_distance(p));
      return values;
    });
    // first where the distance is small, then around what was found: an
    // expression need not be a distance
    const auto octree = growth.grow(around_distances(comm, prm, scene, growth), growth.largest_factor());
    if (!sizing.is_uniform_at_surface())
      return mesh_by_sizes(octree, sizing, growth, scene);
    const BandPoints<dim> points =
      with_way_down(comm, prm, scene, {{prm.surface_level, initial_surface<dim>(octree, scene)}});
    return std::make_shared<const Mesh<dim>>(
      growth.grow_around(*octree, [&](const double) { return points; }));
  }

  template std::shared_ptr<const Mesh<2>>
  initial_mesh(const MPI_Comm &, const Octree<2>::Parameters &, const Scene<2> &);
  template std::shared_ptr<const Mesh<3>>
  initial_mesh(const MPI_Comm &, const Octree<3>::Parameters &, const Scene<3> &);
} // namespace treacle
