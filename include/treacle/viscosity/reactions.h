// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_reactions_h
#define treacle_viscosity_reactions_h

#include <treacle/viscosity/node_system.h>

namespace treacle
{
  /// What the liquid does to a body.
  template <int dim>
  struct Load
  {
    static constexpr unsigned int n_rotations = dim == 2 ? 1 : 3;

    Tensor<1, dim>         force;  ///< N
    Tensor<1, n_rotations> torque; ///< N m
  };

  Tensor<1, 1>
  moment(const Tensor<1, 2> &arm, const Tensor<1, 2> &force);

  Tensor<1, 3>
  moment(const Tensor<1, 3> &arm, const Tensor<1, 3> &force);

  /// The impulse that bodies give to the liquid in one step, as the discrete equations have
  /// it: the viscous step's reaction at prescribed components of nodes, and the pressure on
  /// the closed parts of faces. With a face-fitted mapping the forces are exactly what
  /// changes the momentum of the faces. Bodies are the solids in turn, then the walls of
  /// the box; what an emitter does is left out.
  template <int dim>
  class Reactions
  {
  public:
    /// @p time is that of the domain.
    Reactions(const LiquidDomain<dim> &domain, const double time);

    /// factor times K v, of the stresses in the cells.
    void
    add_stress(const typename NodeSystem<dim>::Stiffness &stiffness,
               const NodeVector<dim>                     &v,
               const double                               factor = 1);

    /// P^T M_f of a change of the face velocity; both have up-to-date ghosts.
    void
    add_inertia(const NodeSystem<dim> &system, const Vector &before, const Vector &after);

    /// Of a pressure (Pa) in cells, zero in the air, over step.
    void
    add_pressure(const Vector &pressure, const double step);

    /// Of the liquid on each body, mean over step; torques about the solid's centre of rotation,
    /// of walls about the middle of the box. Collective.
    std::vector<Load<dim>>
    loads(const double step) const;

    /// What solids and emitters give to the liquid by moving, mean over step (W). Collective.
    double
    power(const double step) const;

  private:
    static constexpr unsigned int none = numbers::invalid_unsigned_int;

    /// The same of a cell that a solid cuts.
    void
    add_stress_of_parts(const typename NodeSystem<dim>::Stiffness &stiffness,
                        const NodeVector<dim>                     &v,
                        const double                               factor,
                        const LocalIndex                           cell);

    unsigned int
    body_of_node(const LocalIndex node) const;

    /// Solid, or none for an emitter.
    unsigned int
    holder(const Point<dim> &x) const;

    /// Impulse at the prescribed components of an owned node.
    void
    add_at_node(const LocalIndex node, const Tensor<1, dim> &impulse);

    void
    add(const unsigned int body, const Point<dim> &x, const Tensor<1, dim> &impulse);

    const LiquidDomain<dim> &domain;
    const double             time;
    std::vector<Point<dim>>  centre; ///< of each body
    std::vector<Load<dim>>   sums;   ///< impulses from the bodies, on this rank
    double                   work = 0; ///< of solids and emitters, on this rank (J)
  };
} // namespace treacle

#endif
