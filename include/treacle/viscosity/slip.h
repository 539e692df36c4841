// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_slip_h
#define treacle_viscosity_slip_h

#include <treacle/viscosity/node_system.h>

#include <optional>

namespace treacle
{
  /// For the node velocity that carries the liquid along: where viscosity spreads momentum over less than a fifth of a
  /// leaf in the longest step, walls and solids hold the nodes in them along their normal alone. The
  /// layer that they slow down is thinner than a leaf there; what is read between a node that stands still and one that
  /// moves would slow down all of that leaf in every step. (Of the longest step, lest nodes are held in some steps and not in others.)
  template <int dim>
  struct Slip
  {
    std::shared_ptr<const LiquidDomain<dim>> domain;  ///< without what does not hold
    typename NodeSystem<dim>::Springs        springs; ///< that hold nodes in solids along their normal

    /// Nothing where no node slips with steps of up to @p longest_step (s). Collective.
    static std::optional<Slip>
    of(const LiquidDomain<dim> &domain, const double longest_step);
  };
} // namespace treacle

#endif
