// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_carried_material_h
#define treacle_surface_carried_material_h

#include <treacle/fields/mesh_data.h>
#include <treacle/fields/state.h>

namespace treacle
{
  /// Material of the scene at t = 0, at the nodes and, where it jumps, at points. Throws a UserError
  /// on all ranks where it makes no sense. Collective.
  template <int dim>
  void
  set_initial_material(State<dim> &state, const MeshData<dim> &data);

  /// After material has moved: where it jumps the points tell the nodes what it is, are thinned out and
  /// sown anew. Then it is carried on into the air: in each of @p n_layers of cells, nodes take the mean
  /// of those around them that have a value already. Collective.
  template <int dim>
  void
  settle_material(State<dim> &state, const MeshData<dim> &data, const unsigned int n_layers);
} // namespace treacle

#endif
