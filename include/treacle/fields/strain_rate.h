// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_strain_rate_h
#define treacle_fields_strain_rate_h

#include <treacle/fields/gradients.h>
#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// e : e of the node velocity v (1/s^2), the mean over the open part of a cell: where a solid cuts it, the wall moves as the solid does.
  template <int dim>
  double
  squared_strain_rate(const LiquidDomain<dim> &domain, const LocalIndex cell, const NodeVector<dim> &v)
  {
    const auto square = [](const Tensor<2, dim> &gradient) {
      const SymmetricTensor<2, dim> e = symmetrize(gradient);
      return e * e;
    };
    const auto parts = domain.cut_cells.parts(cell);
    if (parts.size() == 0)
      return square(velocity_gradient(domain.mesh, cell, v));
    double mean = 0;
    for (const auto &part : parts)
      mean += part.fraction * square(part.velocity_gradient(domain.mesh.cell_nodes[cell], v));
    return mean;
  }

  /// What viscosity takes in a cell (W).
  template <int dim>
  double
  dissipation(const LiquidDomain<dim> &domain, const LocalIndex cell, const NodeVector<dim> &v)
  {
    return 2 * domain.viscosity[cell] * domain.liquid_volume[cell] * squared_strain_rate(domain, cell, v);
  }
} // namespace treacle

#endif
