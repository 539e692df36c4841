// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/maximum.h>
#include <treacle/dynamics/energy_budget.h>
#include <treacle/time_stepping.h>
#include <treacle/transport/face_residual.h>
#include <treacle/transport/velocity_in_time.h>

namespace treacle
{
  namespace
  {
    /// Part of the volume that a step may win or lose before it is repeated.
    constexpr double largest_drift = 0.01;
    /// Part of what the surface moves over that a step may lose before it is repeated: bodies that run into each other over
    /// more than a leaf or two in a step fill the air between them with neither's velocity.
    constexpr double most_swallowed = 0.125;
    /// What swallows more than this part is no such loss: of steps of many leaves a half may be little better, and a quarter good.
    constexpr double most_at_a_rate = 0.5;
    /// Part of the volume that a step may push into walls, before it is repeated.
    constexpr double largest_loss = 0.2;
    /// Where half a step leaves more of it, the mesh is too coarse, not the step.
    constexpr double worth_halving = 0.6;
    /// What moves by less is not repeated.
    constexpr double half_a_leaf = 0.5;
    /// Of the kinetic energy and the range of the potential one, that a step may gain before it is repeated, and
    /// beyond which the run stops.
    constexpr double largest_gain = 0.05, hopeless_gain = 1;
    /// And a step longer than two leaves; then half of it as long as that has a third at most: what is gained at the same rate comes of the mesh.
    constexpr double two_leaves = 2, gain_of_long = 1e-3, worth_halving_again = 0.3;
    /// Times that a step is halved for that.
    constexpr unsigned int most_halvings = 4;

    /// Does what the past did not make expect of the velocity at x come of gravity, in a step dt long
    /// that ends now: of a fall that was not expected, or of how gravity changes? BDF2 makes two thirds
    /// of it where it takes the velocity before to be that of now.
    template <int dim>
    bool
    is_fall(const Tensor<1, dim> &change,
            const Scene<dim>     &scene,
            const Point<dim>     &x,
            const double          time,
            const double          dt)
    {
      Tensor<1, dim> now, before;
      std::string    ignored; // it need not be known in the air
      keep_error(ignored, [&] {
        now    = dt * scene.gravity(x, time);
        before = dt * scene.gravity(x, time - dt);
      });
      const double tolerance = 0.1 * std::max(now.norm(), before.norm());
      const auto   comes_of  = [&](const Tensor<1, dim> &fall) {
        const double square = fall.norm_square();
        const double part   = square > 0 ? std::clamp(change * fall / square, 2. / 3, 1.) : 0.;
        return (change - part * fall).norm() < tolerance;
      };
      return comes_of(now) || comes_of(now - before);
    }

    /// Is the surface to move again, by half a step?
    template <int dim>
    bool
    is_bad(const typename Transport<dim>::Info &info)
    {
      return std::abs(info.drift) > largest_drift || info.swallowed > most_swallowed;
    }

    /// Does half a step help too little? What is lost at the same rate, as where a solid goes through the surface, is lost
    /// in two halves too.
    template <int dim>
    bool
    is_no_better(const typename Transport<dim>::Info &half, const typename Transport<dim>::Info &whole)
    {
      return std::abs(half.drift) > worth_halving * std::abs(whole.drift) ||
             (std::abs(whole.drift) <= largest_drift && whole.swallowed < most_at_a_rate &&
              half.swallowed > worth_halving * whole.swallowed);
    }

    /// Throws a UserError where a step has ended at a time (s) with more energy than halving can have left.
    template <int dim>
    void
    check_excess(const StepInfo<dim> &info, const double time)
    {
      require(info.excess <= hopeless_gain,
              "At t = " + digits(time) + " s the liquid has " + digits(100 * info.excess) +
                " % more energy than forces can have given it, with a step of " + digits(info.dt) +
                " s. Lower Maximum time step or Maximum CFL number, or raise Mesh/Surface level.");
    }

    /// The liquid where it is, with another velocity.
    template <int dim>
    Liquid<dim>
    with_state(const Liquid<dim> &liquid, std::unique_ptr<State<dim>> state)
    {
      return {liquid.mesh_data, std::move(state), liquid.surface, liquid.domain};
    }
  } // namespace

  template <int dim>
  StepInfo<dim>
  TimeStepping<dim>::advance(Liquid<dim> &liquid, double &volume, const StepSize &size) const
  {
    Timer wall;
    scene.check_solids(liquid.state->time + size.dt);
    if (movement.time_step.is_second_order() && !liquid.state->before)
      find_velocity_before(liquid, size.dt);
    StepInfo<dim> info;
    if (switches.surface)
      take_with_care(liquid, volume, size, info);
    else
      take(liquid, volume, size.dt, info);
    info.wall_time = wall.wall_time();
    return info;
  }

  template <int dim>
  void
  TimeStepping<dim>::take_with_care(Liquid<dim>    &liquid,
                                    double         &volume,
                                    const StepSize &size,
                                    StepInfo<dim>  &info) const
  {
    const std::shared_ptr<State<dim>> old        = liquid.state;
    const double                      old_volume = volume;
    const double                      old_drift  = liquid.domain->total_volume() - volume;
    const double                      crossing   = fastest_crossing(*liquid.domain, old->v);
    const EnergyBudget<dim>           budget(*old, *liquid.domain, size.dt);
    double                            past_drift = std::numeric_limits<double>::max(), past_excess = past_drift;
    for (double dt = size.dt, shorter = dt;; dt = shorter)
      {
        const double leaves = take(liquid, volume, dt, info);
        info.excess         = budget.excess(
          *liquid.state, *liquid.domain, {info.dt, info.dynamics.power, info.emitted});
        const double drift = std::abs(liquid.domain->total_volume() - volume - old_drift);
        const double way   = info.dt * crossing; // leaves
        const bool   falls = size.dt > size.falling && info.dt > size.falling && leaves > half_a_leaf;
        shorter            = std::max(0.5 * info.dt, falls && size.bound != StepSize::Bound::frame ? size.falling : 0.);
        if (falls)
          ++info.repetitions.motion;
        else if (drift > largest_drift * volume && way > half_a_leaf &&
                 drift < worth_halving * past_drift)
          ++info.repetitions.volume;
        else if ((info.excess > largest_gain ||
                  (info.excess > gain_of_long && way > two_leaves && info.excess < worth_halving_again * past_excess)) &&
                 info.repetitions.energy < most_halvings)
          {
            ++info.repetitions.energy;
            past_excess = info.excess;
          }
        else
          break;
        past_drift = shorter > 0.5 * info.dt ? std::numeric_limits<double>::max() : drift; // what is not halved does not tell
        liquid = Liquid<dim>::of(old, scene, liquid_domain);
        volume = old_volume;
        // what was held may have begun to fall: what it did before tells nothing of how
        if (movement.time_step.is_second_order())
          find_velocity_before(liquid, shorter);
      }
    check_excess(info, liquid.state->time);
  }

  template <int dim>
  double
  TimeStepping<dim>::take(Liquid<dim>   &liquid,
                          double        &volume,
                          const double   dt,
                          StepInfo<dim> &info) const
  {
    const BackwardDifference difference = move(liquid, dt, volume, info);
    const NodeVector<dim>    expected   = liquid.state->v;
    info.dynamics                       = dynamics.advance(liquid, difference, timing);
    extend_velocity(liquid);
    forget_blows(*liquid.state, *liquid.domain, expected, info.dt);
    return 0.5 * info.dt *
           fastest_crossing(*liquid.domain, combined(1, liquid.state->v, -1, expected));
  }

  template <int dim>
  void
  TimeStepping<dim>::forget_blows(State<dim>              &state,
                                  const LiquidDomain<dim> &domain,
                                  const NodeVector<dim>   &expected,
                                  const double             dt)
  {
    if (!state.before || !state.before->v)
      return;
    const Mesh<dim> &mesh  = domain.mesh;
    const double     least = 0.1 * maximum_speed(state, domain);
    Vector           blow  = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        const Tensor<1, dim> v = state.v.value(node), w = expected.value(node), d = v - w;
        // of the whole velocity a quarter, of what it is in this direction half; a trifle less, for in a new mesh nodes
        // between others that rest and others that move have these parts
        if (d.norm() > std::max(least, 0.2499 * std::max(v.norm(), w.norm())) &&
            d.norm_square() > 0.4999 * std::max(std::abs(v * d), std::abs(w * d)) &&
            !is_fall(d, domain.scene, mesh.node_position[node], state.time, dt))
          {
            state.before->v->set(node, v);
            state.before->v_along->set(node, v);
            blow.local_element(node) = 1;
          }
      }
    state.before->v->update_ghost_values();
    state.before->v_along->update_ghost_values();
    blow.update_ghost_values();
    if (state.before->u)
      forget_missed(state, domain, blow);
  }

  template <int dim>
  BackwardDifference
  TimeStepping<dim>::move(Liquid<dim>   &liquid,
                          const double   dt,
                          double        &volume,
                          StepInfo<dim> &info) const
  {
    const Liquid<dim>  old = liquid;
    BackwardDifference difference(dt, *old.state);
    const double       crossing = fastest_crossing(*old.domain, old.state->v);
    const auto         is_long  = [&] { return difference.dt * crossing > half_a_leaf; };
    const auto transported = [&](Liquid<dim> &moving) {
      return transport(
        moving, difference, volume, is_long() ? largest_loss * volume : std::numeric_limits<double>::max());
    };
    auto moved = transported(liquid);
    while (!moved || (is_bad<dim>(*moved) && is_long()))
      {
        const BackwardDifference whole = difference;
        difference                     = BackwardDifference(0.5 * whole.dt, *old.state);
        Liquid<dim> half               = old;
        auto        half_moved         = transported(half);
        if (moved && half_moved && is_no_better<dim>(*half_moved, *moved))
          {
            difference = whole;
            break;
          }
        liquid = std::move(half);
        moved  = std::move(half_moved);
        ++info.repetitions.volume;
      }
    find(liquid);
    info.dt      = difference.dt;
    info.rebuilt = moved->rebuilt;
    info.emitted = moved->emitted;
    info.drift   = moved->drift;
    volume += moved->emitted;
    if (moved->missing > 0)
      push_out(liquid, *moved, volume);
    return difference;
  }

  template <int dim>
  void
  TimeStepping<dim>::find_velocity_before(Liquid<dim> &liquid, const double dt) const
  {
    liquid.state->before.reset();
    Liquid<dim> ahead = with_state(liquid, copied(*liquid.state));
    const BackwardDifference difference(dt, *ahead.state);
    if (switches.advection)
      movement.move_velocity(ahead, difference, timing);
    else
      timing.measured("advection", [&] { movement.stay(*ahead.state, difference); });
    find(ahead);
    dynamics.advance(ahead, difference, timing);
    extend_velocity(ahead);
    liquid.state->before =
      Transport<dim>::mirrored(liquid, ahead, dt, switches.advection);
  }

  template <int dim>
  std::optional<typename Transport<dim>::Info>
  TimeStepping<dim>::transport(Liquid<dim>              &liquid,
                               const BackwardDifference &difference,
                               const double              volume,
                               const double              most_lost) const
  {
    if (switches.surface)
      return movement.move_liquid(liquid, difference, volume, most_lost, timing);
    if (switches.advection)
      movement.move_velocity(liquid, difference, timing);
    else
      timing.measured("advection", [&] { movement.stay(*liquid.state, difference); });
    return typename Transport<dim>::Info();
  }

  template <int dim>
  void
  TimeStepping<dim>::push_out(Liquid<dim>                         &liquid,
                              const typename Transport<dim>::Info &moved,
                              const double                         volume) const
  {
    // what walls do has been done: they must not push once more
    Liquid<dim> pushed = liquid;
    pushed.domain      = liquid.domain->with_walls_at_rest();
    pushed.state = dynamics.outflow(pushed, lost_by_cells(*liquid.domain, moved.lost), timing);
    if (!pushed.state)
      return;
    extend_velocity(pushed);
    timing.measured("surface", [&] {
      movement.displace(liquid, pushed, moved, volume);
    });
    find(liquid);
  }

  template class TimeStepping<2>;
  template class TimeStepping<3>;
} // namespace treacle
