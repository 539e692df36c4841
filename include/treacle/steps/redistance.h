// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_steps_redistance_h
#define treacle_steps_redistance_h

#include <treacle/fields/state.h>

namespace treacle
{
  /// Gradient of a P1 field at the nodes, the volume-weighted mean over the cells
  /// around each: exact for linear fields. Ghosts of the result are up to date.
  template <int dim>
  NodeVector<dim>
  nodal_gradient(const Mesh<dim> &mesh, const Vector &field);

  /// Make phi a signed distance again, within @p reach of the surface and
  /// clamped beyond. Nodes of cut cells keep their value but for the length of
  /// the gradient there, so that the surface stays where it is.
  template <int dim>
  void
  redistance(State<dim> &state, const double reach);
} // namespace treacle

#endif
