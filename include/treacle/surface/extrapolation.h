// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_extrapolation_h
#define treacle_surface_extrapolation_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/surface/surface_geometry.h>

namespace treacle
{
  /// Extends the node velocity from the active nodes into the air: the velocity of
  /// the nearest point on the surface, within @p reach (m), zero beyond. Prescribed
  /// components are set, and faces without liquid receive P v.
  template <int dim>
  void
  extrapolate(State<dim>                 &state,
              const LiquidDomain<dim>    &domain,
              const SurfaceGeometry<dim> &surface,
              const double                reach);
} // namespace treacle

#endif
