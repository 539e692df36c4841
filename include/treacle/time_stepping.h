// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_time_stepping_h
#define treacle_time_stepping_h

#include <treacle/dynamics/step_info.h>
#include <treacle/transport/transport.h>

#include <optional>

namespace treacle
{
  /// One time step: the liquid moves, then what acts on it changes its velocity.
  template <int dim>
  class TimeStepping
  {
  public:
    /// All must outlive this object.
    TimeStepping(const Scene<dim>                              &scene,
                 const StepSwitches                            &switches,
                 const typename LiquidDomain<dim>::Parameters  &liquid_domain,
                 const Transport<dim>                          &movement,
                 const Dynamics<dim>                           &dynamics,
                 Timing                                        &timing)
      : scene(scene)
      , switches(switches)
      , liquid_domain(liquid_domain)
      , movement(movement)
      , dynamics(dynamics)
      , timing(timing)
    {}

    /// By a step, or less if the surface would win or lose too much, be too far from where the new
    /// velocity takes it, or the liquid gain energy from nowhere, with the volume that the liquid should
    /// have (m^dim) before it, and after it.
    StepInfo<dim>
    advance(Liquid<dim> &liquid, double &volume, const StepSize &size) const;

  private:
    /// Of a size, or halves of it until the surface is where the new velocity takes it, and the
    /// liquid has no more energy than forces can have given it. Throws a UserError on all ranks where
    /// it never has less.
    void
    take_with_care(Liquid<dim>    &liquid,
                   double         &volume,
                   const StepSize &size,
                   StepInfo<dim>  &info) const;

    /// Of a size. Returns how far the surface is from where it would be, had it known the
    /// velocity to come, in leaves.
    double
    take(Liquid<dim> &liquid, double &volume, const double dt, StepInfo<dim> &info) const;

    /// The first step of second order needs to know how the velocity changes, or the surface
    /// would lag behind by g dt^2 / 2 for good: a step of the velocity alone tells, from
    /// which that of the step before is continued.
    void
    find_velocity_before(Liquid<dim> &liquid, const double dt) const;

    /// The liquid moves, all or part of @p dt. Returns the step that it took.
    BackwardDifference
    move(Liquid<dim> &liquid, const double dt, double &volume, StepInfo<dim> &info) const;

    /// Nothing, and nothing moves, if more than @p most_lost (m^dim) would go into walls.
    std::optional<typename Transport<dim>::Info>
    transport(Liquid<dim>              &liquid,
              const BackwardDifference &difference,
              const double              volume,
              const double              most_lost) const;

    /// What a step has pushed into walls and solids comes out again, by the least motion of the
    /// liquid: had it known of them in time, it would not have gone there.
    void
    push_out(Liquid<dim>                         &liquid,
             const typename Transport<dim>::Info &moved,
             const double                         volume) const;

    /// Where the velocity is neither what the past made expect, nor falls from that within @p dt,
    /// there was a blow; continued over it, the past points the wrong way: what falls would bounce.
    /// It is forgotten there.
    static void
    forget_blows(State<dim>              &state,
                 const LiquidDomain<dim> &domain,
                 const NodeVector<dim>   &expected,
                 const double             dt);

    void
    find(Liquid<dim> &liquid) const
    {
      timing.measured("liquid domain", [&] { liquid.find(liquid_domain); });
    }

    void
    extend_velocity(Liquid<dim> &liquid) const
    {
      timing.measured("extrapolation", [&] { movement.extend_velocity(liquid); });
    }

    const Scene<dim>                             &scene;
    const StepSwitches                           &switches;
    const typename LiquidDomain<dim>::Parameters &liquid_domain;
    const Transport<dim>                         &movement;
    const Dynamics<dim>                          &dynamics;
    Timing                                       &timing;
  };
} // namespace treacle

#endif
