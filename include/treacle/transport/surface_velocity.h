// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_surface_velocity_h
#define treacle_transport_surface_velocity_h

#include <treacle/transport/surface_divergence.h>

namespace treacle
{
  /// What moves the surface: the node velocity @p v, but
  /// - in the air up to @p distance (m) from the surface that of the liquid, continued linearly. The fit to
  ///   the faces knows nothing beyond the last of them and continues it as a constant: a wave
  ///   would be late as if its surface lay a third of a leaf deeper (case C4).
  /// - at walls and in solids the velocity of the nodes beside them. With the wall's own a film of
  ///   air would remain under all that falls on it, for a P1 velocity vanishes there. Along the normal of what liquid touches, or stands on,
  ///   it is the wall's: with that of the nodes beside it a film thinner than a leaf would go into the wall.
  /// - beside the surface without @p divergence; null for what pushes liquid out of walls, which has some.
  ///
  /// Velocity itself is not advected with this one: each step would continue what the step
  /// before continued, and flows without viscosity gain energy. Collective.
  template <int dim>
  NodeVector<dim>
  surface_velocity(const State<dim>        &state,
                   const LiquidDomain<dim> &domain,
                   const NodeVector<dim>   &v,
                   const double             distance,
                   SurfaceDivergence<dim>  *divergence);
} // namespace treacle

#endif
