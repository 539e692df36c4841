// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_redistance_h
#define treacle_surface_redistance_h

#include <treacle/fields/state.h>

namespace treacle
{
  /// Make phi a signed distance, within @p reach (m) of the surface and clamped
  /// beyond. The surface stays where it is: near it phi is left alone where it is a
  /// distance well enough, and nodes of cut cells are only ever scaled towards a
  /// gradient of length 1. The @p solid_distance (m) at the nodes tells which parts of it lie in solids (SurfaceDistance).
  template <int dim>
  void
  redistance(State<dim> &state, const double reach, const std::vector<double> &solid_distance = {});
} // namespace treacle

#endif
