// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_correction_h
#define treacle_surface_marker_correction_h

#include <treacle/fields/state.h>

namespace treacle
{
  /// Bring phi at the nodes within 1.25 leaves of markers to the surface the markers lie
  /// on. Collective.
  template <int dim>
  void
  correct_by_markers(State<dim> &state);
} // namespace treacle

#endif
