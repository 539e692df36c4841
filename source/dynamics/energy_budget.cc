// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/maximum.h>
#include <treacle/dynamics/energy_budget.h>

namespace treacle
{
  namespace
  {
    /// Of the finest leaf: liquid that moves by less in a step is at rest, but for what solvers leave.
    constexpr double least_distance = 1e-3;
  } // namespace

  template <int dim>
  EnergyBudget<dim>::EnergyBudget(const State<dim> &state, const LiquidDomain<dim> &domain, const double dt)
    : times{{state.time, state.time + dt}}
    , before(sums(state, domain))
  {}

  template <int dim>
  typename EnergyBudget<dim>::Sums
  EnergyBudget<dim>::sums(const State<dim> &state, const LiquidDomain<dim> &domain) const
  {
    const Mesh<dim>     &mesh = domain.mesh;
    const Tensor<1, dim> box  = domain.scene.upper_corner() - domain.scene.lower_corner();
    Sums                 sums;
    std::string          error;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (const double mass = domain.node_mass[node]; mass > 0)
        keep_error(error, [&] {
          const Tensor<1, dim> v = state.v.value(node);
          const Tensor<1, dim> g = domain.scene.gravity(mesh.node_position[node], state.time);
          sums.kinetic += 0.5 * mass * v.norm_square();
          sums.power += mass * (g * v);
          for (unsigned int d = 0; d < dim; ++d)
            sums.potential += mass * std::abs(g[d]) * box[d];
          sums.mass += mass;
        });
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (const double volume = domain.liquid_volume[c]; volume > 0)
        keep_error(error, [&] {
          const Point<dim> &x = domain.liquid_centre[c];
          for (unsigned int k = 0; k < 2; ++k)
            sums.height[k] -= domain.density[c] * volume * (domain.scene.gravity(x, times[k]) * (x - domain.scene.lower_corner()));
        });
    throw_first(mesh.communicator(), error);
    MPI_Allreduce(
      MPI_IN_PLACE, &sums, sizeof sums / sizeof(double), MPI_DOUBLE, MPI_SUM, mesh.communicator());
    return sums;
  }

  namespace
  {
    /// Of a volume of what comes from an emitter, kinetic energy and with the potential one, at most (J/m^dim). Collective.
    template <int dim>
    std::array<double, 2>
    emitted_energy(const LiquidDomain<dim> &domain, const double time)
    {
      double      speed = 0, density = 0, height = 0; // of the liquid where it is highest (m^2/s^2): the emitter may have stopped
      std::string error;
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        if (domain.is_emitter_node[node])
          speed = std::max(speed, domain.prescribed[node].norm());
      for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
        if (domain.is_active_cell[c])
          keep_error(error, [&] {
            const Point<dim> &x = domain.liquid_centre[c];
            density             = std::max(density, domain.density[c]);
            height = std::max(height, -(domain.scene.gravity(x, time) * (x - domain.scene.lower_corner())));
          });
      throw_first(domain.mesh.communicator(), error);
      const auto   most    = largest(domain.mesh.communicator(), std::array<double, 3>{{speed, density, height}});
      const double kinetic = 0.5 * most[1] * most[0] * most[0];
      return {{kinetic, kinetic + most[1] * most[2]}};
    }
  } // namespace

  template <int dim>
  double
  EnergyBudget<dim>::excess(const State<dim>        &state,
                            const LiquidDomain<dim> &domain,
                            const Input             &input) const
  {
    const Sums   after   = sums(state, domain);
    const double gravity = input.dt * std::max({before.power, after.power, 0.});
    const auto   emitted = input.emitted > 0 ? emitted_energy(domain, state.time) : std::array<double, 2>{{0, 0}};
    const double solids  = input.dt * std::max(input.power, 0.), others = solids + input.emitted * emitted[0];
    const double crawl   = least_distance * domain.mesh.finest_size() / input.dt;
    const double scale   = before.kinetic + before.potential + others + 0.5 * after.mass * crawl * crawl;
    const double kinetic = after.kinetic - before.kinetic;
    // gravity that changes gives and takes
    const double rise = std::min(after.height[0] - before.height[0], after.height[1] - before.height[1]);
    const double more = std::max(kinetic - gravity - others, kinetic + rise - solids - input.emitted * emitted[1]);
    return more > 0 ? more / scale : 0.;
  }

  template class EnergyBudget<2>;
  template class EnergyBudget<3>;
} // namespace treacle
