// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_energy_budget_h
#define treacle_dynamics_energy_budget_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// The energy that the liquid may have at the end of a step: what it had, and what solids and emitters gave it, and of kinetic energy
  /// what gravity gave it too. Viscosity and contact only take.
  template <int dim>
  class EnergyBudget
  {
  public:
    /// Before a step of @p dt (s) at most. Throws a UserError on all ranks where gravity is not finite. Collective.
    EnergyBudget(const State<dim> &state, const LiquidDomain<dim> &domain, const double dt);

    /// What solids and emitters give in a step.
    struct Input
    {
      double dt;      ///< s
      double power;   ///< of forces where velocity is prescribed (W)
      double emitted; ///< volume (m^dim)
    };

    /// By how much the liquid after the step has more, of kinetic energy or in all, over its kinetic energy before plus what it was
    /// given, the range of the potential one in the box, and the kinetic energy of liquid that moves by
    /// a thousandth of the finest leaf in the step; 0 if it has not. Collective.
    double
    excess(const State<dim>        &state,
           const LiquidDomain<dim> &domain,
           const Input             &input) const;

  private:
    /// Sums over nodes; doubles only, so that one call adds those of all ranks.
    struct Sums
    {
      double kinetic   = 0; ///< J
      double power     = 0; ///< of gravity (W)
      double potential = 0; ///< its range in the box (J)
      /// Less what was at the lower corner, by gravity at begin and end of the step (J).
      std::array<double, 2> height = {{0, 0}};
      double mass      = 0; ///< kg
    };

    Sums
    sums(const State<dim> &state, const LiquidDomain<dim> &domain) const;

    const std::array<double, 2> times; ///< of begin and end (s)
    const Sums                  before;
  };
} // namespace treacle

#endif
