// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_solid_normal_h
#define treacle_fields_solid_normal_h

#include <treacle/fields/gradients.h>
#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Unit vector out of the solid that an owned node is in; zero where it has two sides there, as in a plate.
  template <int dim>
  Tensor<1, dim>
  solid_normal(const LiquidDomain<dim> &domain, const LocalIndex node)
  {
    const MeanGradient<dim> slope = mean_gradient(domain.mesh, domain.solid_distance, node);
    return slope.mean.norm() > 0.5 * slope.length ? slope.mean / slope.mean.norm() : Tensor<1, dim>();
  }
} // namespace treacle

#endif
