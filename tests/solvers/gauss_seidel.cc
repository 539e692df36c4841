// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The matrix of a fit to faces between the halves of its symmetric Gauss-Seidel preconditioner is
// symmetric, and conjugate gradients find the solution that those with its diagonal find, in less
// than half of the iterations, or three quarters where each of some ranks has but a few cells. A ball
// beside a wall that sticks has rows of one component by itself, and of three together.

#include "../body.h"

#include <treacle/solvers/gauss_seidel.h>

namespace tests::solvers_gauss_seidel
{
namespace
{
  template <int dim>
  void
  check(const MPI_Comm &comm, const unsigned int level)
  {
    const Body<dim>   body(comm,
                         graded_mesh(level) + "subsection Liquid 1\nset Radius = 0.3\nset Centre = " +
                           (dim == 2 ? "0.503, 0.291" : "0.503, 0.491, 0.282") + "\nend\n");
    const auto        assembled =
      body.fit.system.assemble(NodeSystem<dim>::Mass::faces, {FaceFit<dim>(body.fit, 0.15).regularization(), {}});
    const treacle::Vector b = disorder(body, 0), p = disorder(body, 1);
    const GaussSeidel between(*assembled.matrix);
    treacle::Vector   sb(b), sp(p);
    between.vmult(sb, b);
    between.vmult(sp, p);
    const double difference = std::abs(p * sb - b * sp), size = sb.l2_norm() * p.l2_norm();
    out() << dim << "D, symmetric" << (difference < 1e-13 * size ? "" : ": NO");

    const auto solve = [&](const LinearSolver::Preconditioner preconditioner, treacle::Vector &x) {
      x = 0;
      return LinearSolver({preconditioner, 1e-12, 1000}, "Test", *assembled.matrix).solve(x, b);
    };
    treacle::Vector    x(b), y(b);
    const unsigned int n = solve(LinearSolver::Preconditioner::jacobi, x),
                       m = solve(LinearSolver::Preconditioner::gauss_seidel, y);
    x -= y;
    const double most = Utilities::MPI::n_mpi_processes(comm) == 1 ? 0.5 : 0.75;
    out() << ", the same solution" << (x.linfty_norm() < 1e-10 * y.linfty_norm() ? "" : ": NO") << ", in "
          << (m < most * n ? "less than " : "MORE THAN ") << most << " of the iterations" << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm, 6);
    check<3>(comm, 4);
  });
}

const Test test("solvers/gauss_seidel", start);
} // namespace tests::solvers_gauss_seidel
