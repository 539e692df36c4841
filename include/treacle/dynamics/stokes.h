// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_stokes_h
#define treacle_dynamics_stokes_h

#include <treacle/dynamics/schur_complement.h>
#include <treacle/dynamics/stokes_faces.h>
#include <treacle/viscosity/reactions.h>

#include <deal.II/lac/la_parallel_block_vector.h>

namespace treacle
{
  /// Viscosity and pressure in one solve: the least of Hybrid's energy among face velocities
  /// that are free of divergence. With q = step p, the outflow B u of the pressure cells and
  /// u = (1 - s)(u* + M^-1 B^T q) + s P v there remain, for node velocity and pressure,
  ///
  ///   (K + P^T s M P) v - P^T s B^T q     = P^T s M u*
  ///   -B s P v - B (1 - s) M^-1 B^T q     = B (1 - s) u*,
  ///
  /// symmetric and indefinite, solved by conjugate residuals with a block triangular preconditioner: one
  /// multigrid cycle for the first block, and for the outflow that it leaves an approximate inverse of the
  /// Schur complement.
  template <int dim>
  class Stokes
  {
  public:
    struct Parameters
    {
      double       relative_tolerance = 1e-6;
      unsigned int maximum_iterations = 500;

      void
      add_parameters(ParameterHandler &prm);
    };

    /// Over @p step, that of the backward difference (s). The systems must outlive this object.
    Stokes(const Parameters                          &parameters,
           const LinearSolver::Parameters            &viscosity_solver,
           const NodeSystem<dim>                     &system,
           const typename NodeSystem<dim>::Stiffness &stiffness,
           const PressureSystem<dim>                 &pressure,
           const double                               step);

    Stokes(const Stokes &) = delete;

    /// Sets state.u, which holds u*, state.pressure, and state.v at the active nodes; returns
    /// the number of iterations. Where the solve stagnates: changes nothing and returns
    /// nothing.
    std::optional<unsigned int>
    advance(State<dim> &state, Reactions<dim> &reactions) const;

  private:
    using Pair = LinearAlgebra::distributed::BlockVector<double>; ///< of v and q

    void
    scale(Vector &z, const Vector &r, const unsigned int block) const;

    void
    vmult(Pair &y, const Pair &x) const;

    /// Approximate inverses, symmetric and positive, of the first block and of the Schur complement.
    struct Inverse
    {
      LinearSolver::Operator momentum, schur;
    };

    /// By these inverses: the outflow of r becomes s, what is left of it once A^-1 r_v flows, and y is
    /// A^-1 r_v and S^-1 s. Returns r_v A^-1 r_v + s S^-1 s, the square of the residual's natural norm.
    double
    measure(Pair &y, Pair &r, const Inverse &inverse) const;

    Pair
    right_hand_side(const State<dim> &state) const;

    Pair
    first_guess(const State<dim> &state, const Pair &b) const;

    /// Of what moves: twice its kinetic energy, with x or at a leaf a step, whichever is more, and twice what viscosity takes in
    /// the step (J).
    double
    energy(const Pair &x) const;

    /// Of a residual as measure() leaves it: the norm of the outflow that is left of all cells (m^dim/s).
    double
    outflow_left(const Pair &r, const Pair &y) const;

    /// x to the tolerance times the norm of b, whose square is given, and times that of what moves; the number of
    /// iterations, nothing where it takes more than @p most.
    std::optional<unsigned int>
    improve(Pair              &x,
            const Pair        &b,
            const Inverse     &inverse,
            const double       squared_norm,
            const unsigned int most) const;

    /// Where x is all but right, as in flight. Seen by the diagonal residuals look larger beside
    /// b, for they are rougher.
    std::optional<unsigned int>
    solve_by_diagonal(Pair &x, const Pair &b) const;

    /// Improve x; the number of iterations, nothing where it stagnates.
    std::optional<unsigned int>
    solve(Pair &x, const Pair &b) const;

    /// u from u*, v and q.
    void
    set_faces(State<dim> &state, const Pair &x, Reactions<dim> &reactions) const;

    const Parameters         prm;
    const NodeSystem<dim>   &system;
    const LiquidDomain<dim> &domain;
    const PressureSystem<dim> &pressure;
    const double               step;
    const typename NodeSystem<dim>::Stiffness stiffness;
    const Hybrid<dim>        hybrid;
    const LinearSolver       nodes_solver;
    const StokesFaces<dim>   faces;
    const SchurComplement<dim> schur_complement;
    Pair                       diagonal_inverse;
    const Inverse              hierarchies, diagonals;
    mutable double             tolerated_outflow = 0; ///< (m^dim/s)
    mutable Vector             outflow;               ///< scratch
  };
} // namespace treacle

#endif
