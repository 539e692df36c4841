// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_auxiliary_space_h
#define treacle_viscosity_auxiliary_space_h

#include <treacle/viscosity/face_coupled.h>

namespace treacle
{
  /// The face-coupled step solved with the nodes as auxiliary space. With the node
  /// velocity v = H u and the viscous force f at the nodes, `u = u_old - M_f^-1 H^T f`,
  /// and `K v - f = b`, `-v - G f = -H u_old`, where K = -step D, G = H M_f^-1 H^T, and b
  /// comes from prescribed components. This symmetric indefinite system is solved by
  /// MINRES. Its preconditioner is positive definite: one W-cycle of algebraic multigrid
  /// for (K + diag(m))^-1 and a polynomial in m^-1 W for G^-1, where W = P^T M_f P and m are
  /// the blocks of dim W on the diagonal. A "pair" is a vector that holds v and
  /// then f of this rank.
  template <int dim>
  class AuxiliarySpace
  {
  public:
    /// The operator must outlive this object.
    AuxiliarySpace(const FaceCoupled<dim>                    &face_coupled,
                   const typename NodeSystem<dim>::Stiffness &stiffness,
                   const LinearSolver::Parameters            &parameters);

    AuxiliarySpace(const AuxiliarySpace &) = delete;

    /// Set u to the solution of A u = M_f u + (prescribed components), as exact in
    /// that system as the parameters ask for. Returns the number of iterations.
    unsigned int
    solve(Vector &u) const;

    /// y = the system times x, both pairs.
    void
    vmult(Vector &y, const Vector &x) const;

    /// z = the preconditioner times r, both pairs.
    void
    precondition(Vector &z, const Vector &r) const;

    /// A pair of zeros.
    Vector
    zero() const;

  private:
    void
    set_node_mass();

    /// z = m q(m^-1 W) r, nearly G^-1 r.
    void
    invert_fit(Vector &z, const Vector &r) const;

    /// H M_f^-1 H^T f.
    void
    apply_G(Vector &v, const Vector &f) const;

    /// |M_f u_old + H^T b - A u| for the u that belongs to the f of a pair.
    double
    residual(const Vector &x, const Vector &v_old) const;

    /// Solve for the pair x until that is small over @p norm.
    unsigned int
    minimize(Vector &x, const Vector &rhs, const Vector &v_old, const double norm) const;

    const FaceCoupled<dim>             &face_coupled;
    const NodeSystem<dim>              &system;
    const LinearSolver::Parameters      prm;
    const unsigned int                  n; ///< unknowns v of this rank
    std::vector<Tensor<2, dim>>         m, inverse_m;
    typename NodeSystem<dim>::Assembled fit;               ///< W
    TrilinosWrappers::SparseMatrix      stiff;             ///< K + diag(m)
    std::unique_ptr<const LinearSolver> multigrid;         ///< of it
    mutable Vector                      a, b, c, d, faces; ///< scratch
  };
} // namespace treacle

#endif
