// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_velocity_in_time_h
#define treacle_transport_velocity_in_time_h

#include <treacle/fields/backward_difference.h>
#include <treacle/fields/liquid_domain.h>

#include <array>
#include <functional>

namespace treacle
{
  /// a v + b w, with ghosts. Collective.
  template <int dim>
  NodeVector<dim>
  combined(const double a, const NodeVector<dim> &v, const double b, const NodeVector<dim> &w)
  {
    NodeVector<dim> result = v;
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.component[d].zero_out_ghost_values();
        result.component[d].sadd(a, b, w.component[d]);
      }
    result.update_ghost_values();
    return result;
  }

  /// The velocity of nodes at the begin of a step, after each quarter of it, at its end.
  template <int dim>
  struct StepVelocity
  {
    std::array<NodeVector<dim>, 5> carried; ///< by which velocity is carried along
    std::array<NodeVector<dim>, 5> surface; ///< that moves the surface, and material
  };

  /// The velocity that moves the surface, of one of the liquid, both at nodes. Collective.
  template <int dim>
  using SurfaceVelocityOf = std::function<NodeVector<dim>(const NodeVector<dim> &)>;

  /// The velocity of a state and that of its surface, continued through the step of a backward difference with what the
  /// liquid carries along,
  ///
  ///   v(x, s) = v^n(y) + s/dt' (v^n(z) - v^{n-1}(z')),
  ///
  /// with dt' the step before. What is at x after s was at y at the begin of the step; the way from z' to z, which takes dt',
  /// has the same middle as that from y to x, so that what turns steadily goes on to; of z it is what the nodes about remember, where they do
  /// (VelocityBefore). For components that are held, and farther
  /// than @p reach (m) from the liquid, y, z and z' are x. So at half a step and at its end; quadratic in s between. Where no
  /// velocity is known before, v stays as it is. Collective.
  template <int dim>
  StepVelocity<dim>
  velocity_in_step(const State<dim>             &state,
                   const LiquidDomain<dim>      &domain,
                   const BackwardDifference     &difference,
                   const double                  reach,
                   const SurfaceVelocityOf<dim> &of_surface);
} // namespace treacle

#endif
