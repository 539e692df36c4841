// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/thin_solids.h>
#include <treacle/mesh/surface_size.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    /// Is liquid in a cell around a node, and a wall within half of @p h (m)? A formula's slope is the steepest on the way to its neighbours.
    template <int dim>
    bool
    is_beside_wall(const LiquidDomain<dim> &domain, const LocalIndex node, const double h)
    {
      const Mesh<dim> &mesh = domain.mesh;
      const double     psi  = domain.solid_distance[node];
      if (psi <= 0)
        return false;
      bool   has_liquid = false;
      double slope      = 0;
      for (unsigned int i = mesh.node_cell_start[node]; i < mesh.node_cell_start[node + 1]; ++i)
        {
          has_liquid = has_liquid || domain.liquid_volume[mesh.node_cells[i]] > 0;
          for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[i]])
            if (other != node)
              slope = std::max(slope,
                               std::abs(domain.solid_distance[other] - psi) /
                                 mesh.node_position[other].distance(mesh.node_position[node]));
        }
      return has_liquid && psi < 0.5 * h * slope;
    }

    /// Is what is h (m) behind the nearest wall, straight in, open again, and in the box?
    template <int dim>
    bool
    is_open_behind_wall(const Scene<dim> &scene, const Point<dim> &x, const double psi, const double h, const double time)
    {
      const Distance<dim> distance = [&](const Point<dim> &y) { return scene.solid_distance_within(y, 4 * h, time); };
      const Tensor<1, dim> out   = gradient_of<dim>(distance, x, 0.01 * h);
      const double         slope = out.norm();
      if (!(slope > 0))
        return false;
      const Point<dim> behind = x - (psi / slope + h) / slope * out;
      return scene.box().point_inside(behind) && distance(behind) > 0;
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int>
  thin_solids(const LiquidDomain<dim> &domain, const double time)
  {
    constexpr double    part  = 0.05; // of the places looked at: tips are always thin
    const Scene<dim>   &scene = domain.scene;
    const Mesh<dim>    &mesh  = domain.mesh;
    const unsigned int  n     = scene.n_solids();
    std::vector<double> places(2 * n); // thin ones, then all
    std::string         error;
    keep_error(error, [&] {
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (const double h = surface_size_at_node(mesh, node); is_beside_wall(domain, node, h))
          {
            const Point<dim>  &x = mesh.node_position[node];
            const unsigned int k = scene.nearest_solid(x, time);
            places[k] += is_open_behind_wall(scene, x, domain.solid_distance[node], h, time);
            places[n + k] += 1;
          }
    });
    throw_first(mesh.communicator(), error);
    Utilities::MPI::sum(places, mesh.communicator(), places);
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < n; ++k)
      if (places[k] > part * places[n + k])
        result.push_back(k);
    return result;
  }

  template std::vector<unsigned int>
  thin_solids(const LiquidDomain<2> &, const double);
  template std::vector<unsigned int>
  thin_solids(const LiquidDomain<3> &, const double);
} // namespace treacle
