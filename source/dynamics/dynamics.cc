// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exceptions.h>
#include <treacle/dynamics/dynamics.h>
#include <treacle/dynamics/surface_weight.h>
#include <treacle/viscosity/least_squares.h>

namespace treacle
{
  template <int dim>
  void
  Dynamics<dim>::Parameters::add_parameters(ParameterHandler &handler)
  {
    reconstruction.add_parameters(handler);
    face_fit.add_parameters(handler);
    viscosity.add_parameters(handler);
    handler.enter_subsection("Viscosity");
    add_choice<Coupling>(
      handler,
      "Pressure coupling",
      coupling,
      "Gravity, viscosity and projection in a row, or with a projection before "
      "viscosity too, which follows slow flows much better, or viscosity and "
      "pressure in one solve, with the mapping hybrid alone.",
      {{"split", Coupling::split},
       {"split with first projection", Coupling::split_with_first_projection},
       {"coupled", Coupling::stokes}});
    handler.leave_subsection();
    projection.add_parameters(handler);
    stokes.add_parameters(handler);
  }

  template <int dim>
  Dynamics<dim>::Dynamics(const Parameters &parameters, const StepSwitches &switches, const double longest_step)
    : prm(parameters)
    , switches(switches)
    , longest_step(longest_step)
    , viscosity(parameters.viscosity)
    , reconstruction(parameters.reconstruction)
  {
    require(prm.coupling != Coupling::stokes ||
              prm.viscosity.mapping == Viscosity<dim>::Mapping::hybrid || !switches.pressure ||
              !switches.viscosity,
            "Viscosity/Mapping = " + Viscosity<dim>::mappings.name(prm.viscosity.mapping) +
              " does not go with Pressure coupling = coupled, which is solved with the mapping hybrid: "
              "set Pressure coupling = split with first projection, or Mapping = hybrid.");
  }

  template <int dim>
  struct Dynamics<dim>::Stage
  {
    using Pass = typename Projection<dim>::Pass;

    const Dynamics          &dynamics;
    const LiquidDomain<dim> &domain;
    Timing                  &timing;
    const double             step; ///< of the backward difference (s)
    const bool               is_viscous;
    /// Null if the pressure is turned off.
    std::unique_ptr<const PressureSystem<dim>> pressure;
    std::unique_ptr<const FaceFit<dim>>        fit;
    Reactions<dim>                             reactions;
    typename NodeSystem<dim>::Springs          springs; ///< of the coupled solve
    Info                                       info{};

    Stage(const Dynamics          &dynamics,
          const LiquidDomain<dim> &domain,
          const double             time,
          const double             step,
          Timing                  &timing)
      : dynamics(dynamics)
      , domain(domain)
      , timing(timing)
      , step(step)
      , is_viscous(dynamics.is_viscous(domain))
      , reactions(domain, time)
    {
      if (dynamics.switches.pressure)
        {
          const auto section = timing.section("pressure");
          pressure =
            std::make_unique<const PressureSystem<dim>>(dynamics.prm.projection.solver, domain);
        }
      const auto section = timing.section("face fit");
      fit                = std::make_unique<const FaceFit<dim>>(dynamics.prm.face_fit, domain);
    }

    void
    project(State<dim> &state, const Pass pass)
    {
      if (!pressure)
        return;
      const auto section = timing.section("pressure");
      info.pressure_iterations += Projection<dim>(*pressure).advance(state, step, pass);
    }

    void
    split(State<dim> &state, const bool with_first)
    {
      const bool twice = is_viscous && with_first;
      if (twice)
        project(state, Pass::first);
      if (is_viscous)
        {
          const auto section = timing.section("viscosity");
          info.viscosity_iterations += dynamics.viscosity.advance(state, *fit, step, &reactions);
        }
      project(state, twice ? Pass::correction : Pass::first);
    }

    /// Returns false where the solve stagnates.
    bool
    solve_stokes(State<dim> &state)
    {
      const auto section   = timing.section("coupled");
      auto       stiffness = dynamics.viscosity.stiffness(domain, step);
      stiffness.springs    = springs;
      stiffness.skin       = Skin<dim>(domain, state.phi, step);
      const Stokes<dim> stokes(dynamics.prm.stokes,
                               dynamics.prm.viscosity.solver,
                               fit->system,
                               stiffness,
                               *pressure,
                               step);
      const auto        iterations = stokes.advance(state, reactions);
      if (iterations)
        info.viscosity_iterations += *iterations;
      return iterations.has_value();
    }

    void
    advance(State<dim> &state)
    {
      const Coupling coupling = dynamics.prm.coupling;
      dynamics.forces.advance(state, domain, step);
      // without a pressure cell there is nothing to be coupled
      if (coupling != Coupling::stokes || !is_viscous || !pressure || pressure->rows().size() == 0)
        split(state, coupling != Coupling::split);
      else if (solve_stokes(state))
        project(state, Pass::correction); // what the tolerance leaves
      else
        {
          ++info.fallbacks;
          split(state, true);
        }
      if (pressure)
        reactions.add_pressure(state.pressure, step);
      info.loads              = reactions.loads(step);
      info.power              = reactions.power(step);
      info.maximum_divergence = PressureSystem<dim>::maximum_divergence(state, domain);
    }
  };

  template <int dim>
  bool
  Dynamics<dim>::is_viscous(const LiquidDomain<dim> &domain) const
  {
    const bool here = std::any_of(domain.viscosity.begin(),
                                  domain.viscosity.end(),
                                  [](const double mu) { return mu > 0; });
    return switches.viscosity &&
           Utilities::MPI::max(here ? 1 : 0, domain.mesh.communicator()) > 0;
  }

  template <int dim>
  void
  Dynamics<dim>::reconstruct(State<dim> &state, const Stage &stage) const
  {
    reconstruction.advance(state, *stage.fit, stage.is_viscous ? longest_step : 0);
  }

  template <int dim>
  typename Dynamics<dim>::Info
  Dynamics<dim>::advance(Liquid<dim>              &liquid,
                         const BackwardDifference &difference,
                         Timing                   &timing) const
  {
    State<dim> &state = *liquid.state;
    Stage       stage(*this, *liquid.domain, state.time, difference.step, timing);
    if (is_coupled())
      stage.springs = surface_weight(state, *liquid.domain, liquid.surface->facets, difference);
    stage.advance(state);
    const auto section = timing.section("reconstruction");
    reconstruct(state, stage);
    return stage.info;
  }

  template <int dim>
  void
  Dynamics<dim>::admit(Liquid<dim> &liquid, Timing &timing) const
  {
    State<dim> &state = *liquid.state;
    Stage       stage(*this, *liquid.domain, state.time, 1., timing);
    stage.project(state, Stage::Pass::correction);
    state.pressure = 0; // it was that of a blow
    reconstruct(state, stage);
  }

  template <int dim>
  std::unique_ptr<State<dim>>
  Dynamics<dim>::outflow(const Liquid<dim> &liquid, const Vector &inflow, Timing &timing) const
  {
    if (!switches.pressure)
      return nullptr;
    auto result = copied(*liquid.state);
    result->before.reset();
    result->u = 0;
    timing.measured("pressure", [&] {
      const PressureSystem<dim> pressure(prm.projection.solver, *liquid.domain);
      Projection<dim>(pressure).carry_away(result->u, inflow);
    });
    // it is no flow of a viscous liquid: it slips, and has edges
    LeastSquares<dim>(*liquid.domain).apply(result->u, result->v);
    return result;
  }

  template class Dynamics<2>;
  template class Dynamics<3>;
} // namespace treacle
