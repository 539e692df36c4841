// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_seeding_h
#define treacle_surface_marker_seeding_h

#include <treacle/fields/state.h>
#include <treacle/scene/scene.h>

namespace treacle
{
  /// Take away markers that no longer lie on the surface: 3/4 of a leaf from it, on the
  /// box, in solids, or turned the wrong way; the others take the normal of phi where it
  /// is smooth. Throws a UserError on all ranks
  /// where that leaves too few. Collective.
  template <int dim>
  void
  remove_stray_markers(State<dim> &state, const Scene<dim> &scene);

  /// Thin the markers and add new ones on the surface outside solids: @p per_cell in a
  /// cell that it cuts in a facet of mean size, in number proportional to area.
  /// Partitions do not matter. Collective.
  template <int dim>
  void
  reseed_markers(State<dim> &state, const Scene<dim> &scene, const unsigned int per_cell);
} // namespace treacle

#endif
