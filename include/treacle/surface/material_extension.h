// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_material_extension_h
#define treacle_surface_material_extension_h

#include <treacle/fields/mesh_data.h>
#include <treacle/fields/state.h>

namespace treacle
{
  /// Material of the scene at t = 0, at the nodes. Throws a UserError on all ranks
  /// where it makes no sense. Collective.
  template <int dim>
  void
  set_initial_material(State<dim> &state, const Scene<dim> &scene);

  /// Carry the material on into the air: in each of @p n_layers of cells, nodes take
  /// the mean of those around them that have a value already, in the first those in
  /// the liquid. Collective.
  template <int dim>
  void
  extend_material(State<dim> &state, const MeshData<dim> &data, const unsigned int n_layers);
} // namespace treacle

#endif
