// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_pressure_closed_pockets_h
#define treacle_pressure_closed_pockets_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/numbering.h>

#include <set>

namespace treacle
{
  /// Pockets of liquid without a free surface: there the pressure is known up to a constant,
  /// and what flows in must flow out. Vectors have one entry for each numbered pressure cell.
  template <int dim>
  class ClosedPockets
  {
  public:
    /// Throws a UserError where an emitter pours into a full container. Collective.
    ClosedPockets(const LiquidDomain<dim> &domain, const Numbering &cells);

    /// One row of each pocket, on the rank that has it: where a matrix makes the pressure 0.
    const std::vector<unsigned int> &
    pinned() const
    {
      return pinned_rows;
    }

    /// Take its mean off a right-hand side in each pocket.
    void
    balance(Vector &b) const;

    /// Take the mean of q = step p off in each pocket.
    void
    take_off_mean(Vector &q) const;

    /// Make q = step p zero where it is pinned, the same on any partition.
    void
    take_off_pinned(Vector &q) const;

  private:
    /// The pressure cells of this rank, and how many there are on all ranks.
    struct Pocket
    {
      std::vector<unsigned int> rows;
      GlobalIndex               size = 0;
    };

    /// The labels of connected cells that no air touches.
    std::set<GlobalIndex>
    closed_labels(const Vector &label) const;

    void
    check_room(const Pocket &pocket) const;

    /// Take its weighted mean off q in each pocket; one weight a row.
    void
    take_off_mean(Vector &q, const std::vector<double> &weight) const;

    const LiquidDomain<dim>  &domain;
    const Numbering          &cells;
    std::vector<Pocket>       pockets;
    std::vector<unsigned int> pinned_rows;
  };
} // namespace treacle

#endif
