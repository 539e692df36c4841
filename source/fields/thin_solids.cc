// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/thin_solids.h>

#include <algorithm>
#include <utility>

namespace treacle
{
  namespace
  {
    /// Does solid k, whose wall is @p from_wall (m) off, end again within h (m) behind it, on the way straight in?
    template <int dim>
    bool
    is_thin(const Scene<dim>  &scene,
            const unsigned int k,
            const Point<dim>  &x,
            const double       from_wall,
            const double       h,
            const double       time)
    {
      const Distance<dim>  distance = [&](const Point<dim> &y) { return scene.solid_distance(k, y, time); };
      const Tensor<1, dim> out      = gradient_of<dim>(distance, x, 0.01 * h);
      return out.norm() > 0 && distance(x - (from_wall + h) / out.norm() * out) > 0;
    }

    /// The vertices near walls of cells with liquid, each once, with the cell.
    template <int dim>
    std::vector<std::pair<LocalIndex, LocalIndex>>
    beside_walls(const LiquidDomain<dim> &domain)
    {
      constexpr double                               near = 0.5; // leaves
      std::vector<std::pair<LocalIndex, LocalIndex>> result;
      std::vector<char>                              is_known(domain.solid_distance.size(), 0);
      for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
        if (domain.liquid_volume[c] > 0)
          for (const LocalIndex node : domain.mesh.cell_nodes[c])
            if (const double psi = domain.solid_distance[node];
                psi > 0 && psi < near * domain.mesh.cell_size[c] && !std::exchange(is_known[node], 1))
              result.emplace_back(node, c);
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int>
  thin_solids(const LiquidDomain<dim> &domain, const double time)
  {
    constexpr double    part  = 0.05; // of the places looked at: tips are always thin
    const Scene<dim>   &scene = domain.scene;
    std::vector<double> n_thin(scene.n_solids()), n_places(scene.n_solids());
    std::string         error;
    keep_error(error, [&] {
      for (const auto &[node, c] : beside_walls(domain))
        {
          const Point<dim>  &x = domain.mesh.node_position[node];
          const unsigned int k = scene.nearest_solid(x, time);
          n_thin[k] += is_thin(scene, k, x, domain.solid_distance[node], std::min(domain.mesh.cell_size[c], domain.mesh.surface_size()), time);
          n_places[k] += 1;
        }
    });
    throw_first(domain.mesh.communicator(), error);
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < scene.n_solids(); ++k)
      if (Utilities::MPI::sum(n_thin[k], domain.mesh.communicator()) >
          part * Utilities::MPI::sum(n_places[k], domain.mesh.communicator()))
        result.push_back(k);
    return result;
  }

  template std::vector<unsigned int>
  thin_solids(const LiquidDomain<2> &, const double);
  template std::vector<unsigned int>
  thin_solids(const LiquidDomain<3> &, const double);
} // namespace treacle
