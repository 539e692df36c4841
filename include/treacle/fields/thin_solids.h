// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_thin_solids_h
#define treacle_fields_thin_solids_h

#include <treacle/fields/liquid_domain.h>

#include <vector>

namespace treacle
{
  /// Solids (from 0) that end again within an edge of the leaf behind a wall beside which liquid is, in more than some places: liquid
  /// leaks through them. Collective.
  template <int dim>
  std::vector<unsigned int>
  thin_solids(const LiquidDomain<dim> &domain, const double time);
} // namespace treacle

#endif
