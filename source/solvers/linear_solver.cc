// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exceptions.h>
#include <treacle/base/work.h>
#include <treacle/solvers/decoupled.h>
#include <treacle/solvers/gauss_seidel.h>
#include <treacle/solvers/linear_solver.h>

#include <deal.II/lac/solver_cg.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_utils.h>

#include <sstream>

namespace treacle
{
  namespace
  {
    using Preconditioner = LinearSolver::Preconditioner;

    const Choice<Preconditioner> preconditioners{
      {"amg", Preconditioner::amg},
      {"gauss seidel", Preconditioner::gauss_seidel},
      {"incomplete cholesky", Preconditioner::incomplete_cholesky},
      {"jacobi", Preconditioner::jacobi},
      {"none", Preconditioner::none}};
  } // namespace

  void
  LinearSolver::Parameters::add_parameters(ParameterHandler  &prm,
                                           const std::string &name,
                                           const std::string &remark)
  {
    prm.enter_subsection("Linear solvers");
    prm.enter_subsection(name);
    add_choice(prm,
               "Preconditioner",
               preconditioner,
               "Of the conjugate gradient method: algebraic multigrid, symmetric "
               "Gauss-Seidel, incomplete Cholesky factorization, diagonal, none." +
                 remark,
               preconditioners);
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Norm of the residual over that of the right-hand side; with gauss "
                      "seidel both behind a sweep.",
                      Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "A solve that needs more is an error.",
                      Patterns::Integer(1));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  namespace
  {
    /// Rows that are solved directly.
    constexpr int coarse = 2000;

    std::shared_ptr<TrilinosWrappers::PreconditionBase>
    make_amg(const TrilinosWrappers::SparseMatrix &matrix, NearNullSpace &null_space)
    {
      Teuchos::ParameterList list;
      ML_Epetra::SetDefaults("SA", list);
      list.set("ML output", 0);
      // from random numbers, each time the same: a resumed run must be the same bit for bit.
      // "Anorm" bounds eigenvalues from far above: up to twice the iterations
      list.set("eigen-analysis: type", "cg");
      ML_set_random_seed(1 + Utilities::MPI::this_mpi_process(matrix.get_mpi_communicator()));
      list.set("prec type", "MGW"); // MGV: iterations grow with the level
      list.set("smoother: type", "Chebyshev");
      // a second sweep pays where rotations are smoothed; doc/method.md
      list.set("smoother: sweeps", null_space.n_vectors > null_space.n_components ? 2 : 1);
      list.set("smoother: Chebyshev alpha", 10.);
      list.set("aggregation: type", "Uncoupled");
      list.set("aggregation: threshold", 1e-4);
      list.set("coarse: max size", coarse);
      list.set("coarse: type", "Amesos-KLU");
      list.set("PDE equations", static_cast<int>(null_space.n_components));
      // ML wants a pointer even on a rank without rows
      static double nothing = 0;
      if (null_space.n_vectors > 0)
        {
          list.set("null space: type", "pre-computed");
          list.set("null space: dimension", static_cast<int>(null_space.n_vectors));
          list.set("null space: vectors",
                   null_space.vectors.empty() ? &nothing : null_space.vectors.data());
        }
      auto amg = std::make_shared<TrilinosWrappers::PreconditionAMG>();
      amg->initialize(matrix, list);
      return amg;
    }

    /// ML takes entries below 1e-12 or so for zeros, whatever unit they have: those of a drop of a tenth of a millimetre.
    constexpr double smallest_size = 1e-7;

    /// What a hierarchy is made of, where it is not the matrix itself: a multiple of it; and of components that are
    /// coupled, where no rotations are smoothed, each by itself: a ninth of the work, and hardly more iterations. Small matrices are solved as they are.
    std::shared_ptr<const TrilinosWrappers::SparseMatrix>
    copy_for_amg(const TrilinosWrappers::SparseMatrix &matrix,
                 const double                          factor,
                 const NearNullSpace                  &null_space)
    {
      if (null_space.n_components > 1 && null_space.n_vectors <= null_space.n_components && matrix.m() > coarse)
        return decoupled(matrix, null_space.n_components, factor);
      if (factor == 1)
        return nullptr;
      const auto result = std::make_shared<TrilinosWrappers::SparseMatrix>();
      result->copy_from(matrix);
      *result *= factor;
      return result;
    }
  } // namespace

  namespace
  {
    LinearSolver::Operator
    make_preconditioner(const Preconditioner                 kind,
                        const TrilinosWrappers::SparseMatrix &matrix,
                        const LinearSolver::NearNull         &near_null)
    {
      const auto use = [](const auto p) -> LinearSolver::Operator {
        return [p](Vector &z, const Vector &r) { p->vmult(z, r); };
      };
      const auto make = [&](const auto p) {
        p->initialize(matrix);
        return use(p);
      };
      if (matrix.m() == 0)
        return [](Vector &z, const Vector &r) { z = r; };
      switch (kind)
        {
          case Preconditioner::amg:
            {
              // ML keeps the address of the vectors
              const auto null_space =
                std::make_shared<NearNullSpace>(near_null ? near_null() : NearNullSpace());
              const double size   = matrix.linfty_norm();
              const double factor = size > 0 && size < smallest_size ? 1 / size : 1;
              const auto   copy   = copy_for_amg(matrix, factor, *null_space);
              const auto   amg    = make_amg(copy ? *copy : matrix, *null_space);
              const auto   cycle  = [amg, null_space, copy, factor](Vector &z, const Vector &r) {
                amg->vmult(z, r);
                if (factor != 1)
                  z *= factor;
              };
              if (null_space->turning.n_parts == 0 || matrix.m() <= coarse)
                return cycle;
              const auto balancing = std::make_shared<const Balancing>(matrix, std::move(null_space->turning));
              return [balancing, cycle](Vector &z, const Vector &r) { balancing->apply(z, r, cycle); };
            }
          case Preconditioner::incomplete_cholesky:
            return make(std::make_shared<TrilinosWrappers::PreconditionIC>());
          case Preconditioner::jacobi:
            return make(std::make_shared<TrilinosWrappers::PreconditionJacobi>());
          default:
            return make(std::make_shared<TrilinosWrappers::PreconditionIdentity>());
        }
    }
  } // namespace

  LinearSolver::LinearSolver(const Parameters                     &parameters,
                             const std::string                    &name,
                             const TrilinosWrappers::SparseMatrix &matrix,
                             const NearNull                       &near_null)
    : prm(parameters)
    , name(name)
    , matrix([&matrix](Vector &y, const Vector &x) {
      ++Work::here().products;
      matrix.vmult(y, x);
    })
    , make([kind = prm.preconditioner, &matrix, near_null] {
      return make_preconditioner(kind, matrix, near_null);
    })
    , sweeps_of(prm.preconditioner == Preconditioner::gauss_seidel ? &matrix : nullptr)
  {}

  LinearSolver::LinearSolver(const Parameters  &parameters,
                             const std::string &name,
                             const Operator    &matrix,
                             const Operator    &preconditioner)
    : prm(parameters)
    , name(name)
    , matrix(matrix)
    , preconditioner(preconditioner)
  {}

  void
  LinearSolver::precondition(Vector &z, const Vector &r) const
  {
    ++Work::here().preconditionings;
    if (sweeps_of != nullptr)
      {
        Vector between(r);
        sweeps().forward(between, r);
        sweeps().backward(z, between);
        return;
      }
    if (!preconditioner)
      {
        ++Work::here().preconditioners_made;
        preconditioner = make();
      }
    preconditioner(z, r);
  }

  void
  require_finite(const double norm, const std::string &name)
  {
    require(std::isfinite(norm),
            "Linear solvers/" + name +
              ": the right-hand side is not finite. Look for a velocity or force that grows "
              "without bound; a smaller Maximum time step may help.");
  }

  LinearSolver::~LinearSolver() = default;

  unsigned int
  LinearSolver::solve(Vector &x, const Vector &b, const double scale) const
  {
    const double norm = b.l2_norm();
    if (norm == 0)
      {
        x = 0;
        return 0;
      }
    require_finite(norm, name);
    const double size = std::max(norm, scale);
    if (sweeps_of != nullptr)
      return solve_between_sweeps(x, b, norm, size);
    return iterate(matrix, [this](Vector &z, const Vector &r) { precondition(z, r); }, x, b, norm, size);
  }

  const GaussSeidel &
  LinearSolver::sweeps() const
  {
    if (!made_sweeps)
      {
        ++Work::here().preconditioners_made;
        made_sweeps = std::make_unique<const GaussSeidel>(*sweeps_of);
      }
    return *made_sweeps;
  }

  unsigned int
  LinearSolver::solve_between_sweeps(Vector &x, const Vector &b, const double norm, const double scale) const
  {
    Vector r(b), y(b), correction(b);
    matrix(r, x);
    r.sadd(-1, 1, b);
    if (r.l2_norm() <= prm.relative_tolerance * scale)
      return 0;
    sweeps().forward(y, b);
    const double swept = y.l2_norm();
    sweeps().forward(y, r);
    correction                 = 0;
    const auto         product = [this](Vector &z, const Vector &p) {
      ++Work::here().products;
      sweeps().vmult(z, p);
    };
    const unsigned int n =
      iterate(product, [](Vector &z, const Vector &p) { z = p; }, correction, y, swept, scale / norm * swept);
    sweeps().backward(y, correction);
    x += y;
    return n;
  }

  unsigned int
  LinearSolver::iterate(const Operator &product,
                        const Operator &preconditioned,
                        Vector         &x,
                        const Vector   &b,
                        const double    norm,
                        const double    scale) const
  {
    SolverControl control(prm.maximum_iterations, prm.relative_tolerance * scale);
    try
      {
        SolverCG<Vector> solver(control);
        solver.solve(Multiplies<Vector>{product}, x, b, Multiplies<Vector>{preconditioned});
      }
    catch (const SolverControl::NoConvergence &failure)
      {
        std::ostringstream message;
        message << "Linear solvers/" << name << ": conjugate gradients with preconditioner "
                << preconditioners.name(prm.preconditioner) << " reached a relative residual of "
                << failure.last_residual / norm << " in " << failure.last_step
                << " iterations instead of " << prm.relative_tolerance
                << ". Raise Maximum iterations or Relative tolerance, or choose another "
                   "Preconditioner.";
        throw UserError(message.str());
      }
    return control.last_step();
  }
} // namespace treacle
