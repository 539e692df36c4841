// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/solid_normal.h>
#include <treacle/viscosity/slip.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    /// Of nu dt / h^2, where liquid slips: there faces have more of their own velocity
    /// than of the nodes (viscosity/hybrid).
    constexpr double thin = 0.05;
    /// Of a spring, over the mass of its node's cells, were they full.
    constexpr double stiff = 10;

    /// Is the liquid around an owned node thin?
    template <int dim>
    bool
    is_thin(const LiquidDomain<dim> &domain, const LocalIndex node, const double longest_step)
    {
      const Mesh<dim> &mesh = domain.mesh;
      const auto       cells =
        make_array_view(mesh.node_cells.begin() + mesh.node_cell_start[node],
                        mesh.node_cells.begin() + mesh.node_cell_start[node + 1]);
      return std::all_of(cells.begin(), cells.end(), [&](const LocalIndex c) {
        return !domain.is_active_cell[c] ||
               domain.viscosity[c] * longest_step <
                 thin * domain.density[c] * mesh.cell_size[c] * mesh.cell_size[c];
      });
    }

    /// What walls and solids hold of a node along their normal, bits as LiquidDomain::constrained; in solids springs do.
    /// Walls that are normal to no axis hold all of it.
    template <int dim>
    unsigned char
    held_by_slip(const LiquidDomain<dim> &domain, const LocalIndex node)
    {
      const unsigned int sides = domain.mesh.node_sides[node];
      if (sides >> Walls<dim>::oblique & 1)
        return domain.constrained[node];
      unsigned int held = 0;
      for (unsigned int wall = 0; wall < Walls<dim>::oblique; ++wall)
        if (sides >> wall & 1)
          held |= 1u << Walls<dim>::axis(wall);
      return held & domain.constrained[node];
    }

    /// 1 at active nodes of which walls and solids hold less where the liquid is thin.
    template <int dim>
    Vector
    slipping_nodes(const LiquidDomain<dim> &domain, const double longest_step)
    {
      Vector slips = domain.mesh.zeros(domain.mesh.nodes);
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        slips.local_element(node) = domain.is_active_node[node] && !domain.is_emitter_node[node] &&
                                    domain.constrained[node] != held_by_slip(domain, node) &&
                                    is_thin(domain, node, longest_step) &&
                                    (domain.solid_distance[node] > 0 || solid_normal(domain, node) != Tensor<1, dim>());
      slips.update_ghost_values();
      return slips;
    }

    /// Of an owned node.
    template <int dim>
    double
    strength(const LiquidDomain<dim> &domain, const LocalIndex node)
    {
      const Mesh<dim> &mesh = domain.mesh;
      double           mass = 0;
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        if (const LocalIndex c = mesh.node_cells[k]; domain.is_active_cell[c])
          mass += domain.density[c] * mesh.cell_volume[c] / (dim + 1);
      return stiff * mass;
    }
  } // namespace

  template <int dim>
  std::optional<Slip<dim>>
  Slip<dim>::of(const LiquidDomain<dim> &domain, const double longest_step)
  {
    const Mesh<dim> &mesh  = domain.mesh;
    const Vector     slips = slipping_nodes(domain, longest_step);
    if (slips.linfty_norm() == 0)
      return {};
    const auto is_slipping = [&](const LocalIndex node) { return slips.local_element(node) > 0; };
    const auto slipping    = std::make_shared<LiquidDomain<dim>>(domain);
    Slip       result{slipping, {}};
    for (LocalIndex node = 0; node < mesh.node_position.size(); ++node)
      if (is_slipping(node))
        slipping->constrained[node] = held_by_slip(domain, node);
    // parts that end at the wall would be felt by liquid nodes alone, not by a node in the solid that is free
    slipping->cut_cells.close([&](const LocalIndex c) {
      const auto &nodes = mesh.cell_nodes[c];
      return std::any_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) {
        return domain.solid_distance[node] <= 0 && is_slipping(node);
      });
    });
    result.springs.strength.resize(mesh.node_position.size());
    result.springs.pull.resize(mesh.node_position.size());
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (is_slipping(node) && domain.solid_distance[node] <= 0)
        {
          const Tensor<1, dim> n        = solid_normal(domain, node);
          const double         k        = strength(domain, node);
          result.springs.strength[node] = k * symmetrize(outer_product(n, n));
          result.springs.pull[node]     = k * (domain.prescribed[node] * n) * n;
        }
    return result;
  }

  template struct Slip<2>;
  template struct Slip<3>;
} // namespace treacle
