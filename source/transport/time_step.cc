// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exchange.h>
#include <treacle/base/maximum.h>
#include <treacle/transport/time_step.h>

namespace treacle
{
  template <int dim>
  void
  TimeStep<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("End time", end_time, "When the run ends (s).", Patterns::Double(0));
    prm.add_parameter("Frame interval",
                      frame_interval,
                      "Time between two frames of output (s).",
                      Patterns::Double(1e-12));
    prm.add_parameter("Maximum CFL number",
                      cfl,
                      "Finest leaves that the fastest liquid crosses in a step.",
                      Patterns::Double(1e-3, 100));
    prm.add_parameter("Maximum time step",
                      maximum,
                      "Largest size of a step (s).",
                      Patterns::Double(1e-12));
    add_choice<Scheme>(
      prm,
      "Time scheme",
      scheme,
      "BDF2 is of second order: the derivative of the velocity along paths takes "
      "in the step before, and the surface moves with the velocity of the step's middle. "
      "backward Euler is of first order, and forgets at once.",
      {{"BDF2", Scheme::bdf2}, {"backward Euler", Scheme::backward_euler}});
  }

  namespace
  {
    /// The largest gravity in the liquid, or in the box's middle as long as there is none
    /// (m/s^2). Throws a UserError on all ranks if it is not finite in the liquid. Collective.
    template <int dim>
    double
    maximum_gravity(const LiquidDomain<dim> &domain, const double time)
    {
      const Mesh<dim> &mesh   = domain.mesh;
      double           result = -1; // none
      std::string      error, ignored;
      const auto       include = [&](const Point<dim> &x) {
        result = std::max(result, domain.scene.gravity(x, time).norm());
      };
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        if (domain.liquid_volume[c] > 0)
          keep_error(error, [&] { include(domain.liquid_centre[c]); });
      throw_first(mesh.communicator(), error);
      result = largest(mesh.communicator(), result);
      if (result < 0)
        keep_error(ignored, [&] { include(mesh.middle()); });
      return std::max(result, 0.);
    }
  } // namespace

  template <int dim>
  double
  TimeStep<dim>::next(const State<dim>        &state,
                      const LiquidDomain<dim> &domain,
                      const unsigned int       frame) const
  {
    // the speed at the end of the step counts: v dt + g dt^2 = CFL h
    const double     v        = maximum_speed(state, domain);
    const double     g        = maximum_gravity(domain, state.time);
    const double     distance = prm.cfl * domain.mesh.finest_size();
    double           dt       = prm.maximum;
    if (v + std::sqrt(v * v + 4 * g * distance) > 0)
      dt = std::min(dt, 2 * distance / (v + std::sqrt(v * v + 4 * g * distance)));
    if (is_second_order() && state.before) // two steps of sizes further apart have only first
      dt = std::min(dt, 2 * state.before->dt);

    // equal steps to the frame, or to where an emitter starts or stops
    const double left =
      std::min(frame_time(frame), domain.scene.next_switch(state.time)) - state.time;
    return left / std::max(1., std::ceil(left / dt - 1e-6));
  }

  template <int dim>
  double
  TimeStep<dim>::reach(const State<dim> &state, const LiquidDomain<dim> &domain) const
  {
    const double v  = maximum_speed(state, domain);
    const double g  = maximum_gravity(domain, state.time);
    const double dt = std::min(prm.maximum, prm.frame_interval);
    return std::min(furthest_trace((v + g * dt) * dt) + 4 * domain.mesh.surface_size(),
                    largest_reach(domain.mesh));
  }

  template <int dim>
  double
  maximum_speed(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    double speed = 0;
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      if (domain.is_active_node[node])
        speed = larger(speed, state.v.value(node).norm());
    speed = largest(domain.mesh.communicator(), speed);
    require(std::isfinite(speed),
            "The velocity is not finite at t = " + digits(state.time) +
              " s. Lower Maximum time step or Maximum CFL number; look for a force that grows "
              "without bound.");
    return speed;
  }

  template class TimeStep<2>;
  template class TimeStep<3>;
  template double
  maximum_speed(const State<2> &, const LiquidDomain<2> &);
  template double
  maximum_speed(const State<3> &, const LiquidDomain<3> &);
} // namespace treacle
