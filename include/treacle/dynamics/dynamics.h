// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_dynamics_h
#define treacle_dynamics_dynamics_h

#include <treacle/base/timing.h>
#include <treacle/dynamics/forces.h>
#include <treacle/dynamics/reconstruction.h>
#include <treacle/dynamics/step_switches.h>
#include <treacle/dynamics/stokes.h>
#include <treacle/viscosity/viscosity.h>

namespace treacle
{
  /// What happens to the velocity once the liquid has moved: body force, viscosity and
  /// pressure, one after the other or in one solve, and the velocity for the next move.
  template <int dim>
  class Dynamics
  {
  public:
    struct Parameters
    {
      std::string                              coupling = "coupled";
      typename Viscosity<dim>::Parameters      viscosity;
      typename Projection<dim>::Parameters     projection;
      typename Coupled<dim>::Parameters        coupled;
      typename FaceFit<dim>::Parameters        face_fit;
      typename Reconstruction<dim>::Parameters reconstruction;

      void
      add_parameters(ParameterHandler &prm);
    };

    /// Throws a UserError where the choices do not go together.
    Dynamics(const Parameters &parameters, const StepSwitches &switches);

    struct Info
    {
      unsigned int viscosity_iterations = 0;
      unsigned int pressure_iterations  = 0;
      unsigned int fallbacks            = 0; ///< coupled solves that were split instead
      double       maximum_divergence   = 0; ///< 1/s

      std::vector<Load<dim>> loads; ///< on solids and walls, mean over the step
    };

    /// state.u, v and pressure at state.time, the end of a step; dt is that of its backward difference. The velocity
    /// is known up to @p reach from the surface (m).
    Info
    advance(State<dim>              &state,
            const LiquidDomain<dim> &domain,
            const double             dt,
            const double             reach,
            Timing                  &timing) const;

    /// state.v from state.u, up to @p reach from the surface (m).
    void
    reconstruct(State<dim> &state, const LiquidDomain<dim> &domain, const double reach) const
    {
      reconstruction.advance(state, FaceFit<dim>(prm.face_fit, domain), reach);
    }

    /// Where the liquid is for these steps.
    std::unique_ptr<LiquidDomain<dim>>
    liquid_domain(const State<dim> &state, const Scene<dim> &scene) const;

  private:
    /// A step of the backward difference.
    struct Stage;

    const Parameters          prm;
    const StepSwitches        switches;
    const Forces<dim>         forces{};
    const Viscosity<dim>      viscosity;
    const Reconstruction<dim> reconstruction;
  };
} // namespace treacle

#endif
