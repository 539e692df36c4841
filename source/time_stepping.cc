// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/maximum.h>
#include <treacle/time_stepping.h>

namespace treacle
{
  namespace
  {
    /// Part of the volume that a step may win or lose before it is repeated.
    constexpr double largest_drift = 0.01;
    /// What moves by less is not repeated.
    constexpr double half_a_leaf = 0.5;

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
    if (!switches.surface || size.dt <= size.falling)
      take(liquid, volume, size.dt, info);
    else
      {
        // what was held may have begun to fall: what it did before tells nothing of how
        const Liquid<dim> old        = liquid;
        const double      old_volume = volume;
        double            dt         = size.dt;
        while (take(liquid, volume, dt, info) > half_a_leaf * old.state->mesh->finest_size() &&
               info.dt > size.falling)
          {
            liquid = old;
            volume = old_volume;
            dt     = 0.5 * info.dt;
            find_velocity_before(liquid, dt);
            ++info.repetitions;
            ++info.surprises;
          }
      }
    info.wall_time = wall.wall_time();
    return info;
  }

  namespace
  {
    /// Of velocities at active nodes. Collective.
    template <int dim>
    double
    largest_difference(const LiquidDomain<dim> &domain,
                       const NodeVector<dim>   &v,
                       const NodeVector<dim>   &w)
    {
      double result = 0;
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        if (domain.is_active_node[node])
          result = larger(result, (v.value(node) - w.value(node)).norm());
      return largest(domain.mesh.communicator(), result);
    }
  } // namespace

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
    const double surprise = largest_difference(*liquid.domain, liquid.state->v, expected);
    forget_blows(*liquid.state, *liquid.domain, expected);
    return 0.5 * info.dt * surprise;
  }

  template <int dim>
  void
  TimeStepping<dim>::forget_blows(State<dim>              &state,
                                  const LiquidDomain<dim> &domain,
                                  const NodeVector<dim>   &expected)
  {
    if (!state.before || !state.before->v)
      return;
    const double least = 0.1 * maximum_speed(state, domain);
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      {
        const Tensor<1, dim> v = state.v.value(node), w = expected.value(node);
        if ((v - w).norm() > std::max(least, 0.5 * std::max(v.norm(), w.norm())))
          state.before->v->set(node, v);
      }
    state.before->v->update_ghost_values();
  }

  template <int dim>
  BackwardDifference
  TimeStepping<dim>::move(Liquid<dim>   &liquid,
                          const double   dt,
                          double        &volume,
                          StepInfo<dim> &info) const
  {
    const Liquid<dim>             old = liquid;
    BackwardDifference            difference(dt, *old.state);
    typename Transport<dim>::Info moved = transport(liquid, difference, volume);
    const auto is_long = [&] {
      return difference.dt * maximum_speed(*old.state, *old.domain) >
             half_a_leaf * old.state->mesh->finest_size();
    };
    while (std::abs(moved.drift) > largest_drift && is_long())
      {
        Liquid<dim>                   half = old;
        const BackwardDifference      half_difference(0.5 * difference.dt, *old.state);
        typename Transport<dim>::Info half_moved = transport(half, half_difference, volume);
        // where two halves lose more than the whole, the mesh is too coarse, not the step
        if (std::abs(half_moved.drift) > 0.6 * std::abs(moved.drift))
          break;
        liquid     = std::move(half);
        difference = half_difference;
        moved      = std::move(half_moved);
        ++info.repetitions;
      }
    find(liquid);
    info.dt      = difference.dt;
    info.rebuilt = moved.rebuilt;
    info.emitted = moved.emitted;
    info.drift   = moved.drift;
    volume += moved.emitted;
    if (moved.missing > 0)
      push_out(liquid, moved, volume);
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
      Transport<dim>::mirrored(*liquid.state, *ahead.state, dt, switches.advection);
  }

  template <int dim>
  typename Transport<dim>::Info
  TimeStepping<dim>::transport(Liquid<dim>              &liquid,
                               const BackwardDifference &difference,
                               const double              volume) const
  {
    typename Transport<dim>::Info moved;
    if (switches.surface)
      moved = movement.move_liquid(liquid, difference, volume, timing);
    else if (switches.advection)
      movement.move_velocity(liquid, difference, timing);
    else
      timing.measured("advection", [&] { movement.stay(*liquid.state, difference); });
    return moved;
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
      movement.displace(liquid, pushed, moved.missing, volume);
    });
    find(liquid);
    // a blow: how the velocity changed until now tells nothing of how it will
    if (moved.missing > 1e-3 * volume)
      liquid.state->before.reset();
  }

  template class TimeStepping<2>;
  template class TimeStepping<3>;
} // namespace treacle
