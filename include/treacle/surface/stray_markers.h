// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_stray_markers_h
#define treacle_surface_stray_markers_h

#include <treacle/scene/scene.h>
#include <treacle/surface/surface_geometry.h>

namespace treacle
{
  /// Take away markers that no longer lie on the surface: 3/4 of a leaf from it, on the
  /// box, in solids, turned the wrong way, or where a sheet that faces the other way runs
  /// through them; the others take the normal of phi where it is smooth. Those of films a
  /// leaf thick stay up to a leaf away and keep their normals. Throws a UserError on all
  /// ranks where that leaves too few. With guesses for @p cells; those of the markers that stay. Collective.
  template <int dim>
  Guesses
  remove_stray_markers(State<dim>                 &state,
                       const Scene<dim>           &scene,
                       const SurfaceGeometry<dim> &surface,
                       Guesses                     cells);
} // namespace treacle

#endif
