// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_surface_weight_h
#define treacle_dynamics_surface_weight_h

#include <treacle/fields/backward_difference.h>
#include <treacle/surface/surface.h>
#include <treacle/viscosity/node_system.h>

namespace treacle
{
  /// The weight that the surface gains or loses where it moves to in the next step, as springs for
  /// a solve over the difference's step: without it a liquid that follows its weight at once
  /// swings as soon as a step is longer than it relaxes in. The free surface stabilization of
  /// Kaus, Muehlhaus & May (2010), on how much the velocity changes, not on the velocity: to
  /// second order. A liquid that falls weighs nothing. None up to the steps in which waves as
  /// short as the finest leaves stay stable by themselves, or if there is no velocity before.
  /// Throws a UserError on all ranks where gravity is not finite. Collective.
  template <int dim>
  typename NodeSystem<dim>::Springs
  surface_weight(const State<dim>         &state,
                 const LiquidDomain<dim>  &domain,
                 const Surface<dim>       &surface,
                 const BackwardDifference &difference);
} // namespace treacle

#endif
