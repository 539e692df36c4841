// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_dynamics_h
#define treacle_dynamics_dynamics_h

#include <treacle/base/timing.h>
#include <treacle/dynamics/forces.h>
#include <treacle/dynamics/reconstruction.h>
#include <treacle/dynamics/step_switches.h>
#include <treacle/dynamics/stokes.h>
#include <treacle/fields/backward_difference.h>
#include <treacle/pressure/projection.h>
#include <treacle/surface/liquid.h>
#include <treacle/viscosity/viscosity.h>

namespace treacle
{
  /// What happens to the velocity once the liquid has moved: body force, viscosity and
  /// pressure, one after the other or in one solve, and the velocity for the next move.
  template <int dim>
  class Dynamics
  {
  public:
    /// How viscosity and pressure know of each other.
    enum class Coupling
    {
      split,
      split_with_first_projection,
      stokes
    };

    struct Parameters
    {
      Coupling                                 coupling = Coupling::stokes;
      typename Viscosity<dim>::Parameters      viscosity;
      typename Projection<dim>::Parameters     projection;
      typename Stokes<dim>::Parameters         stokes;
      typename FaceFit<dim>::Parameters        face_fit;
      typename Reconstruction<dim>::Parameters reconstruction;

      void
      add_parameters(ParameterHandler &prm);
    };

    /// Throws a UserError where the choices do not go together. @p longest_step that there may be (s).
    Dynamics(const Parameters &parameters, const StepSwitches &switches, const double longest_step);

    /// Are viscosity and pressure solved for together?
    bool
    is_coupled() const
    {
      return prm.coupling == Coupling::stokes && switches.viscosity && switches.pressure;
    }

    struct Info
    {
      unsigned int viscosity_iterations = 0;
      unsigned int pressure_iterations  = 0;
      unsigned int fallbacks            = 0; ///< coupled solves that were split instead
      double       maximum_divergence   = 0; ///< 1/s

      std::vector<Load<dim>> loads;     ///< on solids and walls, mean over the step
      double                 power = 0; ///< of what solids and emitters do to the liquid (W)
    };

    /// Velocity and pressure of the liquid at the state's time, the end of the difference's step.
    Info
    advance(Liquid<dim>              &liquid,
            const BackwardDifference &difference,
            Timing                   &timing) const;

    /// What walls, solids and the liquid's volume admit of a face velocity: the nearest one; and
    /// the node velocity from it.
    void
    admit(Liquid<dim> &liquid, Timing &timing) const;

    /// A state of the liquid with the velocity that carries away what comes into its cells,
    /// @p inflow (m^dim/s), and no other; null if the pressure is turned off.
    std::unique_ptr<State<dim>>
    outflow(const Liquid<dim> &liquid, const Vector &inflow, Timing &timing) const;

  private:
    /// A step on one surface.
    struct Stage;

    /// Is there a viscosity anywhere, and is it on? Collective.
    bool
    is_viscous(const LiquidDomain<dim> &domain) const;

    /// Node velocity from face velocity.
    void
    reconstruct(State<dim> &state, const Stage &stage) const;

    const Parameters          prm;
    const StepSwitches        switches;
    const double              longest_step; ///< s
    const Forces<dim>         forces{};
    const Viscosity<dim>      viscosity;
    const Reconstruction<dim> reconstruction;
  };
} // namespace treacle

#endif
