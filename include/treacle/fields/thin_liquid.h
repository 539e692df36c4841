// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_thin_liquid_h
#define treacle_fields_thin_liquid_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// 1 at nodes within @p n_layers of nodes of liquid of one of @p is_deep (of owned nodes), 0 at others; ghosts are up to date. Collective.
  template <int dim>
  Vector
  within_layers(const MeshData<dim> &data, const Vector &phi, Vector is_deep, const unsigned int n_layers);

  /// The part of the liquid's volume that is thinner than about a leaf, on solids than half of one: of films, threads and small drops. What
  /// is thicker has nodes that are deeper than a third of a leaf below the surface. Collective.
  template <int dim>
  double
  thin_part(const LiquidDomain<dim> &domain, const Vector &phi);
} // namespace treacle

#endif
