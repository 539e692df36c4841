// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/viscosity/kinks.h>

namespace treacle
{
  template <int dim>
  Kinks<dim>::Kinks(const LiquidDomain<dim> &domain, const std::vector<double> &weight)
  {
    const Mesh<dim> &mesh = domain.mesh;
    if (!domain.viscosity_jumps.empty())
      index.assign(mesh.cell_nodes.size(), invalid);
    for (const auto &[c, jump] : domain.viscosity_jumps)
      {
        if (std::min(jump.viscosity[0], jump.viscosity[1]) == 0 || domain.viscosity[c] == 0)
          continue; // what has no viscosity slides
        if (domain.dual_distance[c] >= 0)
          continue; // a skin's, which takes off from the energy with one viscosity
        Tensor<1, dim> of_distance, of_interpolant; // gradients
        for (unsigned int i = 0; i <= dim; ++i)
          {
            of_distance += jump.distance[i] * mesh.cell_gradients[c][i];
            of_interpolant += std::abs(jump.distance[i]) * mesh.cell_gradients[c][i];
          }
        Kink kink;
        kink.weight = weight[c];
        kink.normal = of_distance / of_distance.norm();
        if (std::abs(of_interpolant * kink.normal) > (1 + 1e-9) * of_distance.norm())
          continue; // so obtuse that |d| - I |d| falls towards the plane on one side
        double stiffer = 0, sum = 0; // of the second side, and of both by their kinks
        for (unsigned int s = 0; s < 2; ++s)
          {
            const double sign = s == 0 ? -1 : 1, viscosity = jump.counted(s);
            kink.sides[s] = {weight[c] / domain.viscosity[c] * viscosity * jump.part[s], sign * of_distance - of_interpolant};
            stiffer += sign * viscosity;
            sum += sign * viscosity * (kink.sides[s].gradient * kink.normal);
          }
        kink.slope = -stiffer / sum;
        index[c]   = kinks.size();
        kinks.push_back(kink);
      }
  }

  template <int dim>
  Tensor<2, dim>
  Kinks<dim>::stress(const LocalIndex cell, const Tensor<2, dim> &gradient) const
  {
    const Kink           &kink = kinks[index[cell]];
    const Tensor<1, dim> &n    = kink.normal;
    const auto            across = [&](const Tensor<1, dim> &x) { return x - (x * n) * n; };
    const auto            twice_symmetric = [](const Tensor<1, dim> &x, const Tensor<1, dim> &y) {
      return outer_product(x, y) + outer_product(y, x);
    };
    const Tensor<2, dim> twice_strain = gradient + transpose(gradient);
    const Tensor<1, dim> a            = kink.slope * across(twice_strain * n);
    Tensor<2, dim>       result       = -kink.weight * twice_strain;
    Tensor<1, dim>       on_kink;
    for (const auto &side : kink.sides)
      {
        const Tensor<2, dim> stress = side.weight * (twice_strain + twice_symmetric(a, side.gradient));
        result += stress;
        on_kink += stress * side.gradient;
      }
    return result + kink.slope * twice_symmetric(across(on_kink), n);
  }

  template class Kinks<2>;
  template class Kinks<3>;
} // namespace treacle
