// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_backward_difference_h
#define treacle_fields_backward_difference_h

#include <treacle/fields/state.h>

namespace treacle
{
  /// The time derivative at the end of a step, along a path:
  /// (u^{n+1} - now u^n - before u^{n-1}) / step. Backward Euler, or BDF2 for steps of any
  /// two sizes where the velocity of the step before is known.
  struct BackwardDifference
  {
    double dt;   ///< from u^n to u^{n+1} (s)
    double step; ///< that a force at the end acts over (s): dt, or about 2/3 dt
    double now    = 1;
    double before = 0;

    /// For a step of size @p dt from the state @p old.
    template <int dim>
    BackwardDifference(const double dt, const State<dim> &old)
      : dt(dt)
      , step(dt)
    {
      // BDF2 is stable as long as a step is at most 1 + sqrt(2) times the one before; steps that
      // double, and are rounded to end with a frame, are of second order
      constexpr double largest_growth = 2 + 1e-5;
      if (!old.before || dt > largest_growth * old.before->dt)
        return;
      const double ratio = dt / old.before->dt;
      step               = dt * (1 + ratio) / (1 + 2 * ratio);
      now                = (1 + ratio) * (1 + ratio) / (1 + 2 * ratio);
      before             = -ratio * ratio / (1 + 2 * ratio);
    }
  };
} // namespace treacle

#endif
