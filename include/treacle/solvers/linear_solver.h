// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_linear_solver_h
#define treacle_solvers_linear_solver_h

#include <treacle/base/types.h>
#include <treacle/solvers/balancing.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <memory>
#include <string>

namespace treacle
{
  class GaussSeidel;

  /// Smooth vectors that a matrix hardly sees (owned entries, vector by vector);
  /// without any, constants of each of n_components.
  struct NearNullSpace
  {
    unsigned int        n_components = 1;
    unsigned int        n_vectors    = 0;
    std::vector<double> vectors;
    PartMotions         turning; ///< of parts by themselves, for which the preconditioner is made exact
  };

  /// As deal.II's solvers want a linear map.
  template <typename VectorType>
  struct Multiplies
  {
    std::function<void(VectorType &, const VectorType &)> vmult;
  };

  /// Throws a UserError on all ranks alike if the norm of a right-hand side is not finite;
  /// not-a-number would pass through the solver as if there were nothing to do.
  void
  require_finite(const double norm, const std::string &name);

  /// Conjugate gradients on a symmetric positive definite matrix or operator.
  class LinearSolver
  {
  public:
    /// Sets its first argument to a linear map of the second.
    using Operator = std::function<void(Vector &, const Vector &)>;

    enum class Preconditioner
    {
      amg,
      gauss_seidel,
      incomplete_cholesky,
      jacobi,
      none
    };

    struct Parameters
    {
      Preconditioner preconditioner     = Preconditioner::amg;
      double         relative_tolerance = 1e-6;
      unsigned int   maximum_iterations = 1000;

      /// Subsection Linear solvers / @p name. A remark goes into the documentation
      /// of the preconditioner.
      void
      add_parameters(ParameterHandler  &prm,
                     const std::string &name,
                     const std::string &remark = "");
    };

    /// For multigrid alone, which asks when it needs them. Collective.
    using NearNull = std::function<NearNullSpace()>;

    /// The matrix, and what @p near_null refers to, must outlive this object. The
    /// preconditioner is made when it is first needed: a first guess may do without.
    LinearSolver(const Parameters                     &parameters,
                 const std::string                    &name,
                 const TrilinosWrappers::SparseMatrix &matrix,
                 const NearNull                       &near_null = {});

    /// For an operator that is no matrix, with its preconditioner.
    LinearSolver(const Parameters  &parameters,
                 const std::string &name,
                 const Operator    &matrix,
                 const Operator    &preconditioner);

    ~LinearSolver();

    /// Improve x until |b - A x| <= tolerance max(|b|, @p scale), with Gauss-Seidel the norms of what the first
    /// sweep makes of both. Returns the number of iterations. Throws a UserError where it does not get there.
    unsigned int
    solve(Vector &x, const Vector &b, const double scale = 0) const;

    double
    relative_tolerance() const
    {
      return prm.relative_tolerance;
    }

    /// z = the preconditioner times r. Collective.
    void
    precondition(Vector &z, const Vector &r) const;

  private:
    /// Those of the matrix, made when they are first needed.
    const GaussSeidel &
    sweeps() const;

    /// As iterate(), between sweeps of Gauss-Seidel, unless the first guess will do as it is.
    unsigned int
    solve_between_sweeps(Vector &x, const Vector &b, const double norm, const double scale) const;

    /// Until |b - A x| <= tolerance @p scale. An error tells of the residual in parts of @p norm.
    unsigned int
    iterate(const Operator &product,
            const Operator &preconditioned,
            Vector         &x,
            const Vector   &b,
            const double    norm,
            const double    scale) const;

    const Parameters          prm;
    const std::string         name;
    Operator                  matrix;
    std::function<Operator()> make;
    mutable Operator          preconditioner; ///< empty before it is made
    /// Null with another preconditioner than Gauss-Seidel.
    const TrilinosWrappers::SparseMatrix      *sweeps_of = nullptr;
    mutable std::unique_ptr<const GaussSeidel> made_sweeps; ///< null before
  };
} // namespace treacle

#endif
