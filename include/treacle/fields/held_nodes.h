// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_held_nodes_h
#define treacle_fields_held_nodes_h

#include <treacle/fields/state.h>
#include <treacle/scene/scene.h>

#include <vector>

namespace treacle
{
  /// What prescribes the velocity of nodes, local ones.
  template <int dim>
  struct HeldNodes
  {
    /// Bit d is set where component d is prescribed (no slip, free slip, solids,
    /// emitters).
    std::vector<unsigned char>  constrained;
    std::vector<Tensor<1, dim>> prescribed; ///< the values, m/s
  };

  /// A wall (Walls: a side of the box, or what a mesh from a file calls so) holds the nodes at which it touches
  /// liquid: at which one of their cells has a liquid node on the same wall, or a face on it and pressure, which bears the liquid above air thinner than
  /// the cell. What has yet to come down on a floor does not feel it.
  /// Solids, where their distance is not positive, and emitters hold all their nodes.
  /// Collective. Throws a UserError on all ranks where a velocity makes no sense.
  template <int dim>
  HeldNodes<dim>
  held_nodes(const Scene<dim>                 &scene,
             const State<dim>                 &state,
             const std::vector<double>        &solid_distance,
             const std::vector<unsigned char> &is_emitter_node,
             const std::vector<unsigned char> &is_pressure_cell);
} // namespace treacle

#endif
