// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The energy budget of a step on a free disc and sphere that move in one direction: what is allowed, and
// what is too much.

#include "../tests.h"
#include "../body.h"

#include <treacle/dynamics/energy_budget.h>

#include <iomanip>

namespace tests::dynamics_energy_budget
{
namespace
{
  /// Excess over a step of 0.1 s in which the velocity along x changes from @p before to @p after.
  template <int dim>
  double
  excess(const MPI_Comm &comm, const std::string &gravity, const double before, const double after, const double power)
  {
    Body<dim>  body(comm,
                   graded_mesh(4) + "subsection Liquid 1\nset Radius = 0.3\nset Centre = 0.5, 0.5" +
                     (dim == 2 ? "" : ", 0.5") + "\nend\nsubsection Gravity\nset Acceleration = " + gravity +
                     (dim == 2 ? "" : "; 0") + "\nend\n");
    const auto set = [&](const double speed) {
      body.state.v.component[0] = speed;
      body.state.v.update_ghost_values();
    };
    set(before);
    const EnergyBudget<dim> budget(body.state, body.domain);
    set(after);
    return budget.excess(body.state, body.domain, {0.1, power, 0.});
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    out() << dim << "D: steady " << excess<dim>(comm, "0; 0", 1, 1, 0) << ", slower "
          << excess<dim>(comm, "0; 0", 1, 0.5, 0) << ", twice as fast " << excess<dim>(comm, "0; 0", 1, 2, 0)
          << ", in free fall " << excess<dim>(comm, "10; 0", 1, 2, 0) << ", pushed by a solid "
          << excess<dim>(comm, "0; 0", 1, 2, 1e9) << ", noise of a body at rest "
          << (excess<dim>(comm, "0; 0", 0, 1e-8, 0) < 1e-6 ? "none" : "COUNTED") << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    out() << std::setprecision(4);
    check<2>(comm);
    check<3>(comm);
  });
}

const Test test("dynamics/energy_budget", start);
} // namespace tests::dynamics_energy_budget
