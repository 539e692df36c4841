// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_face_fit_h
#define treacle_viscosity_face_fit_h

#include <treacle/fields/face_node.h>
#include <treacle/viscosity/slip.h>

namespace treacle
{
  /// The node velocity that fits the face velocity best: the minimiser of
  /// `1/2 |P v - u|^2 in M_f + 1/2 v·S v`, where S is a strain energy of weight
  /// 1e-2 h^2 or as given. Rigid motions are reproduced exactly on any graded mesh with any
  /// surface.
  template <int dim>
  class FaceFit
  {
  public:
    struct Parameters
    {
      LinearSolver::Parameters solver{LinearSolver::Preconditioner::gauss_seidel, 1e-9, 2000};

      void
      add_parameters(ParameterHandler &prm)
      {
        solver.add_parameters(prm, "Face fit");
      }
    };

    FaceFit(const Parameters &parameters, const LiquidDomain<dim> &domain);

    /// The same with another weight of the strain energy, in parts of h^2.
    FaceFit(const FaceFit &other, const double strain_weight);

    /// And with walls and solids that do not hold all that they touch; @p slip must outlive this object.
    FaceFit(const FaceFit &other, const Slip<dim> &slip, const double strain_weight);

    /// Set v at the active nodes from u, starting from what it holds. Returns
    /// the number of iterations. The first call sets up the solver. Collective.
    unsigned int
    solve(const Vector &u, NodeVector<dim> &v) const;

    /// Weight of S in each cell, to be added to any other strain term.
    const std::vector<double> &
    regularization() const
    {
      return stiffness.strain;
    }

  private:
    const Parameters                             prm;
    const std::shared_ptr<const NodeSystem<dim>> shared_system;

  public:
    const NodeSystem<dim>   &system;
    const LiquidDomain<dim> &domain;

  private:
    FaceFit(const Parameters                             &parameters,
            const std::shared_ptr<const NodeSystem<dim>> &system,
            const double                                  strain_weight);

    typename NodeSystem<dim>::Stiffness         stiffness;
    mutable typename NodeSystem<dim>::Assembled assembled;
    mutable std::unique_ptr<LinearSolver>       solver; ///< null before the first solve
  };
} // namespace treacle

#endif
