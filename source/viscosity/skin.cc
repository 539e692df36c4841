// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/viscosity/skin.h>

namespace treacle
{
  template <int dim>
  Skin<dim>::Skin(const LiquidDomain<dim> &domain, const Vector &phi, const double step)
    : part(domain.mesh.cell_nodes.size())
    , normal(part.size())
  {
    for (LocalIndex c = 0; c < part.size(); ++c)
      if (domain.is_active_cell[c] && domain.dual_distance[c] >= 0)
        if (const Tensor<1, dim> gradient = cell_gradient(domain.mesh, c, phi); gradient.norm() > 0)
          {
            part[c]   = stiff_part(domain.viscosity[c] / domain.density[c] * step / std::pow(domain.mesh.cell_size[c], 2));
            normal[c] = gradient / gradient.norm();
          }
  }

  template class Skin<2>;
  template class Skin<3>;
} // namespace treacle
