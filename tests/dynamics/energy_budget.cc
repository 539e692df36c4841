// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The energy budget of a step on a free disc and sphere that move in one direction: what is allowed, and
// what is too much, of kinetic energy and in all.

#include "../tests.h"
#include "../body.h"

#include <treacle/dynamics/energy_budget.h>

#include <iomanip>

namespace tests::dynamics_energy_budget
{
namespace
{
  /// A step of 0.1 s along x, as gravity does.
  struct Step
  {
    double      before, after;    ///< velocity (m/s)
    double      way     = 0;      ///< m
    double      power   = 0;      ///< of solids (W)
    std::string gravity = "0; 0"; ///< m/s^2
  };

  template <int dim>
  double
  excess(const MPI_Comm &comm, const Step &step)
  {
    Body<dim>  body(comm,
                   graded_mesh(4) + "subsection Liquid 1\nset Radius = 0.3\nset Centre = 0.5, 0.5" +
                     (dim == 2 ? "" : ", 0.5") + "\nend\nsubsection Gravity\nset Acceleration = " + step.gravity +
                     (dim == 2 ? "" : "; 0") + "\nend\n");
    State<dim>      &state = body.state;
    const Mesh<dim> &mesh  = *state.mesh;
    state.v.component[0]   = step.before;
    state.v.update_ghost_values();
    const EnergyBudget<dim> budget(state, body.domain, 0.1);
    Tensor<1, dim>          way;
    way[0]               = step.way;
    state.v.component[0] = step.after;
    state.v.update_ghost_values();
    state.phi.zero_out_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      state.phi.local_element(node) = body.scene.liquid_distance(mesh.node_position[node] - way);
    state.phi.update_ghost_values();
    return budget.excess(state, LiquidDomain<dim>(body.prm.liquid_domain, state, body.data), {0.1, step.power, 0.});
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    const auto        of      = [&](const Step &step) { return excess<dim>(comm, step); };
    const auto        is_none = [&](const Step &step) { return of(step) < 2e-3 ? "none" : "SOME"; };
    const std::string down = "10; 0", turning = "10 * cos(pi * t / 0.1); 0";
    out() << dim << "D: steady " << of({1, 1}) << ", slower " << of({1, 0.5}) << ", twice as fast " << of({1, 2})
          << ", in free fall " << is_none({1, 2, 0.15, 0, down}) << ", without falling " << of({1, 2, 0, 0, down})
          << ", lifted " << of({1, 1, -0.1, 0, down}) << ", lifted where gravity turns round "
          << is_none({1, 1, -0.1, 0, turning}) << ", pushed by a solid " << of({1, 2, 0, 1e9})
          << ", noise of a body at rest " << (of({0, 1e-8}) < 1e-6 ? "none" : "COUNTED") << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    out() << std::setprecision(2);
    check<2>(comm);
    check<3>(comm);
  });
}

const Test test("dynamics/energy_budget", start);
} // namespace tests::dynamics_energy_budget
