// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_thin_solids_h
#define treacle_fields_thin_solids_h

#include <treacle/fields/liquid_domain.h>

#include <vector>

namespace treacle
{
  /// Solids (from 0) that are open again within a leaf of the surface behind a wall beside liquid, in more than some places: it leaks
  /// through them. Collective.
  template <int dim>
  std::vector<unsigned int>
  thin_solids(const LiquidDomain<dim> &domain, const double time);
} // namespace treacle

#endif
