// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_step_switches_h
#define treacle_dynamics_step_switches_h

#include <treacle/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// Which parts of a time step are taken: all, but for isolated cases.
  struct StepSwitches
  {
    bool surface   = true; ///< phi, markers and mesh move on
    bool advection = true; ///< of velocity and carried material
    bool viscosity = true;
    bool pressure  = true;

    /// Does anything move?
    bool
    moves() const
    {
      return surface || advection;
    }

    /// Subsection Steps.
    void
    add_parameters(ParameterHandler &prm);

    /// Throws a UserError where the combination makes no sense.
    template <int dim>
    void
    check(const Scene<dim> &scene) const;
  };
} // namespace treacle

#endif
