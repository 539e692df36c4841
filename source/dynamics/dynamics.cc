// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/dynamics/dynamics.h>

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
    handler.add_parameter("Pressure coupling",
                          coupling,
                          "Gravity, viscosity and projection in a row, or with a projection before "
                          "viscosity too, which follows slow flows much better, or viscosity and "
                          "pressure in one solve, with the mapping hybrid alone.",
                          Patterns::Selection("split|split with first projection|coupled"));
    handler.leave_subsection();
    projection.add_parameters(handler);
    coupled.add_parameters(handler);
  }

  template <int dim>
  Dynamics<dim>::Dynamics(const Parameters &parameters, const StepSwitches &switches)
    : prm(parameters)
    , switches(switches)
    , viscosity(parameters.viscosity)
    , reconstruction(parameters.reconstruction)
  {
    require(prm.coupling != "coupled" || prm.viscosity.mapping == "hybrid" || !switches.pressure ||
              !switches.viscosity,
            "Viscosity/Mapping = " + prm.viscosity.mapping +
              " does not go with Pressure coupling = coupled, which is solved with the mapping hybrid: "
              "set Pressure coupling = split with first projection, or Mapping = hybrid.");
  }

  template <int dim>
  std::unique_ptr<LiquidDomain<dim>>
  Dynamics<dim>::liquid_domain(const State<dim> &state, const Scene<dim> &scene) const
  {
    using Hold = typename LiquidDomain<dim>::Hold;
    return std::make_unique<LiquidDomain<dim>>(state,
                                               scene,
                                               prm.projection.minimum_theta,
                                               prm.viscosity.solid_walls == "nodes" ? Hold::nodes :
                                                                                      Hold::walls);
  }

  template <int dim>
  struct Dynamics<dim>::Stage
  {
    const Dynamics                        &dynamics;
    const LiquidDomain<dim>               &domain;
    Timing                                &timing;
    std::unique_ptr<const Projection<dim>> projection;
    std::unique_ptr<const FaceFit<dim>>    fit;
    Reactions<dim>                         reactions;
    const bool                             is_viscous; ///< anywhere
    Info                                   info{};

    void
    project(State<dim> &state, const double dt, const typename Projection<dim>::Pass pass)
    {
      if (!projection)
        return;
      const auto section = timing.section("pressure");
      info.pressure_iterations += projection->advance(state, dt, pass);
    }

    void
    split(State<dim> &state, const double dt, const bool with_first)
    {
      using Pass       = typename Projection<dim>::Pass;
      const bool twice = is_viscous && with_first;
      if (twice)
        project(state, dt, Pass::first);
      if (is_viscous)
        {
          const auto section = timing.section("viscosity");
          info.viscosity_iterations += dynamics.viscosity.advance(state, *fit, dt, &reactions);
        }
      project(state, dt, twice ? Pass::correction : Pass::first);
    }

    /// Returns false where the solve stagnates.
    bool
    couple(State<dim> &state, const double dt)
    {
      const auto         section = timing.section("coupled");
      const Coupled<dim> coupled(dynamics.prm.coupled,
                                 dynamics.prm.viscosity.solver,
                                 fit->system,
                                 dynamics.viscosity.stiffness(domain, dt),
                                 *projection,
                                 dt);
      const auto         iterations = coupled.advance(state, reactions);
      if (iterations)
        info.viscosity_iterations += *iterations;
      return iterations.has_value();
    }

    void
    advance(State<dim> &state, const double dt)
    {
      dynamics.forces.advance(state, domain, dt);
      // without a pressure cell there is nothing to be coupled
      if (dynamics.prm.coupling != "coupled" || !is_viscous || !projection ||
          projection->pressure_rows().size() == 0)
        split(state, dt, dynamics.prm.coupling != "split");
      else if (couple(state, dt))
        // what the tolerance of the coupled solve leaves
        project(state, dt, Projection<dim>::Pass::correction);
      else
        {
          ++info.fallbacks;
          split(state, dt, true);
        }
      if (projection)
        reactions.add_pressure(state.pressure, dt);
    }
  };

  template <int dim>
  typename Dynamics<dim>::Info
  Dynamics<dim>::advance(State<dim>              &state,
                         const LiquidDomain<dim> &domain,
                         const double             dt,
                         const double             reach,
                         Timing                  &timing) const
  {
    const bool has_viscosity =
      std::any_of(domain.viscosity.begin(), domain.viscosity.end(), [](const double mu) { return mu > 0; });
    Stage stage{*this,
                domain,
                timing,
                nullptr,
                nullptr,
                Reactions<dim>(domain, state.time),
                switches.viscosity &&
                  Utilities::MPI::max(has_viscosity ? 1 : 0, domain.mesh.communicator()) > 0};
    if (switches.pressure)
      {
        const auto section = timing.section("pressure");
        stage.projection   = std::make_unique<const Projection<dim>>(prm.projection, domain);
      }
    {
      const auto section = timing.section("face fit");
      stage.fit          = std::make_unique<const FaceFit<dim>>(prm.face_fit, domain);
    }
    stage.advance(state, dt);
    stage.info.loads              = stage.reactions.loads(dt);
    stage.info.maximum_divergence = Projection<dim>::maximum_divergence(state, domain);
    const auto section            = timing.section("reconstruction");
    reconstruction.advance(state, *stage.fit, reach);
    return stage.info;
  }

  template class Dynamics<2>;
  template class Dynamics<3>;
} // namespace treacle
