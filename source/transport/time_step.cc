// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exceptions.h>
#include <treacle/base/exchange.h>
#include <treacle/base/maximum.h>
#include <treacle/fields/strain_rate.h>
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
                      "Leaves that liquid crosses in a step, each of those that are there; inside the liquid they "
                      "count as no larger than the surface's.",
                      Patterns::Double(1e-3, 100));
    prm.add_parameter("Maximum time step",
                      maximum,
                      "Largest size of a step (s). 0: 0.04 s, but where viscosity holds the liquid, no solid moves, and neither gravity nor "
                      "an emitter changes, any that CFL number and frames allow, in which the velocity changes by no more than a quarter of itself.",
                      Patterns::Double(0));
    add_choice<Scheme>(
      prm,
      "Time scheme",
      scheme,
      "BDF2 is of second order: the derivative of the velocity along paths takes "
      "in the step before, and the surface moves with the velocity of the step's middle. "
      "backward Euler is of first order, and forgets at once.",
      {{"BDF2", Scheme::bdf2}, {"backward Euler", Scheme::backward_euler}});
  }

  template <int dim>
  TimeStep<dim>::TimeStep(const Parameters &parameters)
    : prm(parameters)
  {
    require(prm.maximum == 0 || prm.maximum >= 1e-12, "Maximum time step must be 0 or at least 1e-12 s.");
  }

  namespace
  {
    /// Of itself, that the velocity may change in a step that is longer than a fall allows.
    constexpr double largest_change = 0.25;
    /// Of the leaf that is there: what moves by less need not be followed in time.
    constexpr double least_distance = 1e-3;

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

    /// The longest step in which what begins with v does not go further than a distance with the
    /// acceleration g.
    double
    longest_step(const double v, const double g, const double distance)
    {
      return 2 * distance / (v + std::sqrt(v * v + 4 * g * distance));
    }

    /// The longest in which nothing crosses more leaves. Collective.
    template <int dim>
    double
    longest_step(const State<dim>        &state,
                 const LiquidDomain<dim> &domain,
                 const double             g,
                 const double             leaves)
    {
      const Mesh<dim> &mesh    = domain.mesh;
      double           longest = longest_step(0, g, leaves * largest_surface_size(mesh));
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (domain.is_active_node[node])
          longest = std::min(longest,
                             longest_step(state.v.value(node).norm(),
                                          g,
                                          leaves * surface_size_at_node(mesh, node)));
      return Utilities::MPI::min(longest, mesh.communicator());
    }

    /// How the velocity has changed in the step before.
    struct Change
    {
      double fastest;        ///< largest acceleration (m/s^2)
      double rate;           ///< |dv/dt| / |v|, both in the mean (1/s)
      double kinetic_energy; ///< now (J)
    };

    /// Collective.
    template <int dim>
    Change
    change_before(const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      double       fastest = 0;
      Tensor<1, 2> squares; // of the acceleration and of the velocity, times mass
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        if (domain.is_active_node[node])
          {
            const Tensor<1, dim> v = state.v.value(node);
            const double change    = (v - state.before->v->value(node)).norm() / state.before->dt;
            fastest                = std::max(fastest, change);
            squares[0] += domain.node_mass[node] * change * change;
            squares[1] += domain.node_mass[node] * v.norm_square();
          }
      const MPI_Comm &comm = domain.mesh.communicator();
      squares = Utilities::MPI::sum(squares, comm);
      return {largest(comm, fastest), squares[1] > 0 ? std::sqrt(squares[0] / squares[1]) : 0., squares[1] / 2};
    }

    /// Does viscosity take so much in a step that the liquid knows nothing of how it moved before? Collective.
    template <int dim>
    bool
    forgets(const LiquidDomain<dim> &domain, const NodeVector<dim> &v, const double kinetic_energy, const double dt)
    {
      constexpr double times = 10; // the kinetic energy
      double           power = 0;  // W
      for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
        if (domain.liquid_volume[c] > 0)
          power += dissipation(domain, c, v);
      return Utilities::MPI::sum(power, domain.mesh.communicator()) * dt > times * kinetic_energy;
    }

    /// Does viscosity carry what happens at the surface in a step? Waves as short as a leaf are
    /// gone then, and the nodes hold the faces (Hybrid). Collective.
    template <int dim>
    bool
    is_viscous_at_surface(const LiquidDomain<dim> &domain, const double dt)
    {
      constexpr double viscous = 0.05; // nu dt / h^2
      const Mesh<dim> &mesh    = domain.mesh;
      bool             result  = true;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        if (domain.liquid_volume[c] > 0 && domain.liquid_volume[c] < mesh.cell_volume[c])
          result = result && domain.viscosity[c] * dt >=
                               viscous * domain.density[c] * std::pow(mesh.cell_size[c], 2);
      return Utilities::MPI::min(result ? 1 : 0, mesh.communicator()) > 0;
    }
  } // namespace

  std::string
  StepSize::bounded_by() const
  {
    switch (bound)
      {
        case Bound::cfl:
          return "CFL";
        case Bound::weight:
          return "weight";
        case Bound::change:
          return "change";
        case Bound::growth:
          return "growth";
        case Bound::maximum:
          return "maximum";
        default:
          return "frame";
      }
  }

  template <int dim>
  StepSize
  TimeStep<dim>::next(const State<dim>        &state,
                      const LiquidDomain<dim> &domain,
                      const unsigned int       frame,
                      const Motion            &motion) const
  {
    using Bound = StepSize::Bound;
    StepSize size{longest_free(), Bound::maximum, longest_free()};
    if (motion.moves)
      find_longest(state, domain, motion, size);
    // two steps of sizes further apart have only first order
    if (is_second_order() && state.before && 2 * state.before->dt < size.dt)
      {
        size.dt    = 2 * state.before->dt;
        size.bound = Bound::growth;
      }

    // equal steps to the frame, or to where an emitter starts or stops
    const double left =
      std::min(frame_time(frame), domain.scene.next_switch(state.time)) - state.time;
    const double n = std::max(1., std::ceil(left / size.dt - 1e-6));
    if (n == 1)
      size.bound = Bound::frame;
    size.dt = left / n;
    return size;
  }

  template <int dim>
  void
  TimeStep<dim>::find_longest(const State<dim>        &state,
                              const LiquidDomain<dim> &domain,
                              const Motion            &motion,
                              StepSize                &size) const
  {
    // the speed at the end of the step counts: v dt + g dt^2 = CFL h
    const double v = maximum_speed(state, domain), g = maximum_gravity(domain, state.time);
    size.falling   = longest_step(state, domain, g, prm.cfl);
    if (size.falling < size.dt)
      {
        size.dt    = size.falling;
        size.bound = g * size.dt > v ? StepSize::Bound::weight : StepSize::Bound::cfl;
      }
    const double held = longest_held(domain.scene);
    if (held <= size.dt || !motion.is_coupled || !state.before || !state.before->v ||
        !is_viscous_at_surface(domain, size.dt))
      return;
    const Change change    = change_before(state, domain);
    const double a         = std::min(g, 2 * change.fastest);
    const double by_change = std::max(largest_change / change.rate, least_distance / fastest_crossing(domain, state.v));
    const double by_cfl    = longest_step(state, domain, a, prm.cfl);
    const bool   is_bound  = held > longest_free() && !forgets(domain, state.v, change.kinetic_energy, std::min(by_change, by_cfl));
    const std::array<std::pair<double, StepSize::Bound>, 3> bounds{
      {{by_change, StepSize::Bound::change},
       {by_cfl, StepSize::Bound::cfl},
       {is_bound ? longest_free() : held, StepSize::Bound::maximum}}};
    const auto &[dt, bound] = *std::min_element(bounds.begin(), bounds.end());
    if (dt > size.dt)
      std::tie(size.dt, size.bound) = std::tie(dt, bound);
  }

  template <int dim>
  double
  TimeStep<dim>::reach(const State<dim> &state, const LiquidDomain<dim> &domain) const
  {
    const double v  = maximum_speed(state, domain);
    const double g  = maximum_gravity(domain, state.time);
    const double dt = longest_held(domain.scene);
    return std::min((v + g * dt) * dt + 4 * domain.mesh.surface_size(), largest_reach(domain.mesh));
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

  template <int dim>
  double
  fastest_crossing(const LiquidDomain<dim> &domain, const NodeVector<dim> &v)
  {
    double result = 0;
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      if (domain.is_active_node[node])
        result = larger(result, v.value(node).norm() / surface_size_at_node(domain.mesh, node));
    return largest(domain.mesh.communicator(), result);
  }

  template class TimeStep<2>;
  template class TimeStep<3>;
  template double
  maximum_speed(const State<2> &, const LiquidDomain<2> &);
  template double
  maximum_speed(const State<3> &, const LiquidDomain<3> &);
  template double
  fastest_crossing(const LiquidDomain<2> &, const NodeVector<2> &);
  template double
  fastest_crossing(const LiquidDomain<3> &, const NodeVector<3> &);
} // namespace treacle
