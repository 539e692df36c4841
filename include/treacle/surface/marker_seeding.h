// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_seeding_h
#define treacle_surface_marker_seeding_h

#include <treacle/scene/scene.h>
#include <treacle/surface/surface_geometry.h>

namespace treacle
{
  /// Thin the markers and add new ones on the surface outside solids: @p per_cell in a
  /// cell that it cuts in a facet of mean size, in number proportional to area.
  /// Partitions do not matter. With guesses for the @p cells of the markers. Collective.
  template <int dim>
  void
  reseed_markers(State<dim>                 &state,
                 const Scene<dim>           &scene,
                 const SurfaceGeometry<dim> &surface,
                 const unsigned int          per_cell,
                 const Guesses              &cells);
} // namespace treacle

#endif
