// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_connected_liquid_h
#define treacle_fields_connected_liquid_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/numbering.h>

#include <set>

namespace treacle
{
  /// Of each numbered cell the smallest number among the cells that liquid faces connect it
  /// with, over all ranks; of owned cells and ghosts, -1 for cells without a
  /// number. Collective.
  template <int dim>
  Vector
  label_connected(const LiquidDomain<dim> &domain, const Numbering &cells);

  /// The labels that any rank has. Collective.
  std::set<GlobalIndex>
  everywhere(const MPI_Comm &comm, const std::set<GlobalIndex> &here);
} // namespace treacle

#endif
