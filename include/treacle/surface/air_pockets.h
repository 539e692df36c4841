// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_air_pockets_h
#define treacle_surface_air_pockets_h

#include <treacle/fields/mesh_data.h>
#include <treacle/fields/state.h>

namespace treacle
{
  /// Air has no pressure, so that liquid fills what air it encloses, and in the end faster than a step can follow: then
  /// what flows in is lost. Parts of the air about as thin as a leaf become liquid, and their markers go, if a step @p dt (s)
  /// with the velocity of the liquid about them would fill more than half of them, or if they are smaller than a leaf and do not
  /// open; so do gaps between liquid that are open elsewhere, where they are as thin and a step fills as much. Not at solids,
  /// gaps not at sides of the box either. phi is a distance within @p reach (m), with up-to-date ghosts before and after.
  /// Collective.
  template <int dim>
  void
  close_air_pockets(State<dim> &state, const MeshData<dim> &data, const double dt, const double reach);
} // namespace treacle

#endif
