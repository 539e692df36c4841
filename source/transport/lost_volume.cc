// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/mesh/tracer.h>
#include <treacle/transport/lost_volume.h>

namespace treacle
{
  namespace
  {
    /// How deep in a wall a point is (m), negative outside, and the way out of it.
    template <int dim>
    struct Depth
    {
      double         value;
      Tensor<1, dim> outward;
    };

    /// Beyond the nearest side of the box.
    template <int dim>
    Depth<dim>
    depth_beyond(const BoundingBox<dim> &box, const Point<dim> &x)
    {
      Depth<dim> deepest{-std::numeric_limits<double>::max(), {}};
      for (unsigned int side = 0; side < 2 * dim; ++side)
        {
          const unsigned int d    = side / 2;
          const double       sign = side % 2 == 0 ? 1 : -1;
          const double value = sign * ((side % 2 == 0 ? box.lower_bound(d) : box.upper_bound(d)) - x[d]);
          if (value > deepest.value)
            {
              deepest            = {value, {}};
              deepest.outward[d] = sign;
            }
        }
      return deepest;
    }

    /// In the solids; @p h is the length that slopes are taken over, for an expression need
    /// not be a distance.
    template <int dim>
    Depth<dim>
    depth_in_solids(const Scene<dim> &scene, const Point<dim> &x, const double time, const double h)
    {
      Tensor<1, dim> slope;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Point<dim> lower = x, upper = x;
          lower[d] -= 0.5 * h;
          upper[d] += 0.5 * h;
          slope[d] = (scene.solid_distance(upper, time) - scene.solid_distance(lower, time)) / h;
        }
      const double steepness = slope.norm();
      return steepness == 0 ? Depth<dim>{0, {}} :
                              Depth<dim>{-scene.solid_distance(x, time) / steepness, slope / steepness};
    }

    template <int dim>
    Depth<dim>
    depth_in_walls(const Scene<dim> &scene, const Mesh<dim> &mesh, const Point<dim> &x, const double time)
    {
      const Depth<dim> beyond = depth_beyond(mesh.box(), x);
      // few points are in solids, and the slope costs more than the distance
      if (!scene.is_in_solids(x, time))
        return beyond;
      const Depth<dim> inside = depth_in_solids(scene, x, time, 0.1 * mesh.finest_size());
      return inside.value > beyond.value ? inside : beyond;
    }
  } // namespace

  namespace
  {
    /// Call @p visit with each vertex of each facet, and its part of the area vector of the facet afterwards.
    template <int dim, typename Visit>
    void
    for_each_corner(const MovedSurface<dim> &surface, const Visit &visit)
    {
      for (unsigned int k = 0; k < surface.before.facets.size(); ++k)
        {
          const Tensor<1, dim> area = area_vector<dim>(surface.before.facet_points(k, surface.after)) / dim;
          for (const unsigned int i : surface.before.facets[k])
            visit(i, area);
        }
    }
  } // namespace

  template <int dim>
  std::vector<LostVolume<dim>>
  lost_in_walls(const Scene<dim>        &scene,
                const MovedSurface<dim> &surface,
                const double             time_before,
                const double             time_after)
  {
    const auto             &[mesh, before, after] = surface;
    std::vector<Depth<dim>> depth(after.size(), {0, {}});
    std::string             error;
    keep_error(error, [&, &mesh = mesh, &before = before, &after = after] {
      for (unsigned int i = 0; i < after.size(); ++i)
        if (const Depth<dim> now = depth_in_walls(scene, mesh, after[i], time_after);
            now.value > 0 &&
            depth_in_walls(scene, mesh, before.positions[i], time_before).value <= 0)
          depth[i] = now;
    });
    throw_first(mesh.communicator(), error);
    std::vector<LostVolume<dim>> lost;
    for_each_corner(surface, [&, &after = after](const unsigned int i, const Tensor<1, dim> &area) {
      if (depth[i].value > 0)
        lost.push_back({after[i] + depth[i].value * depth[i].outward,
                        depth[i].outward,
                        -depth[i].value * (area * depth[i].outward)});
    });
    return lost;
  }

  template <int dim>
  std::vector<LostVolume<dim>>
  lost_in_liquid(const Scene<dim> &scene, const MovedSurface<dim> &surface, const State<dim> &state)
  {
    const auto &[mesh, before, after] = surface;
    const std::vector<double> phi = Tracer<dim>(*state.mesh).evaluate(after, {{&state.phi}});
    std::vector<bool>         is_buried(after.size());
    std::string               error;
    keep_error(error, [&, &mesh = mesh, &before = before, &after = after] {
      for (unsigned int i = 0; i < after.size(); ++i)
        {
          const auto  &vertex = before.vertices[i];
          const double edge   = mesh.node_position[vertex.a].distance(mesh.node_position[vertex.b]);
          is_buried[i] =
            phi[i] < -0.5 * edge && depth_in_walls(scene, mesh, after[i], state.time).value <= 0;
        }
    });
    throw_first(mesh.communicator(), error);
    std::vector<LostVolume<dim>> lost;
    for_each_corner(surface,
                    [&, &before = before, &after = after](const unsigned int i, const Tensor<1, dim> &area) {
                      if (const double swept = area * (after[i] - before.positions[i]);
                          is_buried[i] && swept > 0)
                        lost.push_back({after[i], -area / area.norm(), swept});
                    });
    return lost;
  }

  template <int dim>
  double
  swept_outwards(const MovedSurface<dim> &surface)
  {
    const auto &[mesh, before, after] = surface;
    double volume                     = 0;
    for (unsigned int k = 0; k < before.facets.size(); ++k)
      {
        Tensor<1, dim> way;
        for (const unsigned int i : before.facets[k])
          way += (after[i] - before.positions[i]) / dim;
        volume += std::max(0., area_vector<dim>(before.facet_points(k)) * way);
      }
    return Utilities::MPI::sum(volume, mesh.communicator());
  }

  template <int dim>
  std::vector<Parcel<dim>>
  parcels_of(const std::vector<LostVolume<dim>> &lost, const double volume, const double way, const MPI_Comm &comm)
  {
    const double             all = sum(lost, comm);
    std::vector<Parcel<dim>> parcels;
    if (all > 0)
      for (const LostVolume<dim> &part : lost)
        parcels.push_back({part.entry + way * part.outward, volume / all * part.volume});
    return parcels;
  }

  namespace
  {
    /// A point, then the entry, the way out and the volume.
    template <int dim>
    using Sent = std::array<double, 3 * dim + 1>;

    template <int dim>
    Sent<dim>
    packed(const Point<dim> &point, const LostVolume<dim> &part)
    {
      Sent<dim> numbers;
      for (unsigned int d = 0; d < dim; ++d)
        {
          numbers[d]           = point[d];
          numbers[dim + d]     = part.entry[d];
          numbers[2 * dim + d] = part.outward[d];
        }
      numbers[3 * dim] = part.volume;
      return numbers;
    }

    template <int dim>
    std::pair<Point<dim>, LostVolume<dim>>
    unpacked(const Sent<dim> &numbers)
    {
      std::pair<Point<dim>, LostVolume<dim>> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.first[d]          = numbers[d];
          result.second.entry[d]   = numbers[dim + d];
          result.second.outward[d] = numbers[2 * dim + d];
        }
      result.second.volume = numbers[3 * dim];
      return result;
    }

    /// Volume by nodes, and then by the pressure cells around them: vertices of a surface lie on edges, so that what they lose lies just
    /// between two cells, and by the last digit in one of them.
    template <int dim>
    class Spreading
    {
    public:
      explicit Spreading(const LiquidDomain<dim> &domain)
        : domain(domain)
        , mesh(domain.mesh)
        , at_nodes(mesh.zeros(mesh.nodes))
        , around(mesh.nodes)
      {
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
            around.local_element(node) += weight(mesh.node_cells[k]);
        around.update_ghost_values();
      }

      /// Send each part to the owner of the cell at @p offset (m) from the wall; returns what is of nodes without a pressure cell around.
      /// Collective.
      std::vector<LostVolume<dim>>
      add(const std::vector<LostVolume<dim>> &lost, const double offset)
      {
        const MPI_Comm         &comm = mesh.communicator();
        std::vector<Point<dim>> x;
        for (const LostVolume<dim> &part : lost)
          x.push_back(part.entry + offset * part.outward);
        const auto         owners = mesh.locator().owners(x);
        PerRank<Sent<dim>> to_rank(Utilities::MPI::n_mpi_processes(comm));
        for (unsigned int i = 0; i < lost.size(); ++i)
          to_rank[owners[i].rank].push_back(packed(owners[i].point, lost[i]));
        std::vector<LostVolume<dim>> left;
        for (const auto &received : send_and_receive(comm, to_rank))
          for (const Sent<dim> &numbers : received)
            {
              auto [point, part] = unpacked<dim>(numbers);
              const Location<dim> place = mesh.locator().locate_here(point);
              const double        volume = part.volume;
              part.volume = 0;
              for (unsigned int i = 0; i <= dim; ++i)
                {
                  const LocalIndex node = mesh.cell_nodes[place.cell][i];
                  (around.local_element(node) > 0 ? at_nodes.local_element(node) : part.volume) += place.lambda[i] * volume;
                }
              if (part.volume > 0)
                left.push_back(part);
            }
        return left;
      }

      /// Collective.
      Vector
      by_cells()
      {
        at_nodes.compress(VectorOperation::add);
        at_nodes.update_ghost_values();
        Vector volume(mesh.cells);
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          for (const LocalIndex node : mesh.cell_nodes[c])
            if (const double all = around.local_element(node); all > 0)
              volume.local_element(c) += weight(c) / all * at_nodes.local_element(node);
        volume.update_ghost_values();
        return volume;
      }

    private:
      double
      weight(const LocalIndex cell) const
      {
        return domain.is_pressure_cell[cell] ? domain.liquid_volume[cell] : 0.;
      }

      const LiquidDomain<dim> &domain;
      const Mesh<dim>         &mesh;
      Vector                   at_nodes;
      Vector                   around; ///< weight of all cells
    };
  } // namespace

  template <int dim>
  Vector
  lost_by_cells(const LiquidDomain<dim> &domain, const std::vector<LostVolume<dim>> &lost)
  {
    Spreading<dim>               spreading(domain);
    std::vector<LostVolume<dim>> left    = lost;
    const double                 largest = largest_surface_size(domain.mesh);
    for (double offset = 0.5 * domain.mesh.finest_size(); offset < 3 * largest; offset *= 2)
      left = spreading.add(left, offset);
    return spreading.by_cells();
  }

#define INSTANTIATE(dim)                                                                      \
  template std::vector<LostVolume<dim>> lost_in_walls(const Scene<dim> &,                     \
                                                      const MovedSurface<dim> &,              \
                                                      const double,                           \
                                                      const double);                          \
  template std::vector<LostVolume<dim>> lost_in_liquid(const Scene<dim> &,                    \
                                                       const MovedSurface<dim> &,             \
                                                       const State<dim> &);                   \
  template double swept_outwards(const MovedSurface<dim> &);                                  \
  template std::vector<Parcel<dim>> parcels_of(const std::vector<LostVolume<dim>> &,          \
                                               const double,                                  \
                                               const double,                                  \
                                               const MPI_Comm &);                             \
  template Vector lost_by_cells(const LiquidDomain<dim> &, const std::vector<LostVolume<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
