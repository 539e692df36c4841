// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_energy_budget_h
#define treacle_dynamics_energy_budget_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// The kinetic energy that the liquid may have at the end of a step: what it had, and what
  /// gravity, solids and emitters gave it. Viscosity and contact only take.
  template <int dim>
  class EnergyBudget
  {
  public:
    /// Before a step. Throws a UserError on all ranks where gravity is not finite. Collective.
    EnergyBudget(const State<dim> &state, const LiquidDomain<dim> &domain);

    /// What solids and emitters give in a step.
    struct Input
    {
      double dt;      ///< s
      double power;   ///< of forces where velocity is prescribed (W)
      double emitted; ///< volume (m^dim)
    };

    /// By how much the liquid after the step has more, over its kinetic energy before
    /// plus the range of the potential one in the box; 0 if it has not. Collective.
    double
    excess(const State<dim>        &state,
           const LiquidDomain<dim> &domain,
           const Input             &input) const;

  private:
    /// Sums over nodes.
    struct Sums
    {
      double kinetic   = 0; ///< J
      double power     = 0; ///< of gravity (W)
      double potential = 0; ///< its range in the box (J)
    };

    static Sums
    sums(const State<dim> &state, const LiquidDomain<dim> &domain);

    const Sums before;
  };
} // namespace treacle

#endif
