// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_skin_h
#define treacle_viscosity_skin_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// The cells that the free surface cuts and that have no pressure of their own, whose liquid is free to change its volume then: what is
  /// pulled along the surface resists half as much as it should. There the stress along the normal n is zero, so that p = 2 mu n·e n, and nothing
  /// flows out, so that n·e n = -tr e_t, with e_t the strain rate along the surface. Both follow from
  ///
  ///   e_t : e_t + 2 |e_tn|^2 + (tr e_t)^2 + (div v)^2   in place of   e : e = e_t : e_t + 2 |e_tn|^2 + (n·e n)^2
  ///
  /// in the energy that viscosity takes: its least is at div v = 0, where the stress is that of liquid under this pressure. Of stiff liquid
  /// all of it.
  template <int dim>
  class Skin
  {
  public:
    /// None.
    Skin() = default;

    /// In a step (s) by the gradient of phi (m) in these cells, with up-to-date ghosts.
    Skin(const LiquidDomain<dim> &domain, const Vector &phi, const double step);

    /// What the surface of stiff liquid needs has this part where viscosity spreads over @p spread squares of the leaf in a step, nu dt / h^2:
    /// what spreads over less keeps the motion of its surface, by which a stream that draws air into a pool keeps its volume.
    static double
    stiff_part(const double spread)
    {
      constexpr double half = 8;
      return spread * spread / (half * half + spread * spread);
    }

    /// Is a cell one of these?
    bool
    has(const LocalIndex cell) const
    {
      return !part.empty() && part[cell] > 0;
    }

    /// Of one of these, half of what comes to the second variation of e : e, for gradients of the weights of two nodes (1/m): row of
    /// the first, column of the second.
    Tensor<2, dim>
    block(const LocalIndex cell, const Tensor<1, dim> &g, const Tensor<1, dim> &other) const
    {
      const Tensor<1, dim> &n = normal[cell], along_g = g - (g * n) * n, along_other = other - (other * n) * n;
      return part[cell] * (outer_product(g, other) + outer_product(along_g, along_other) -
                           (g * n) * (other * n) * outer_product(n, n));
    }

    /// What comes to its e, as stress over 2 mu, of a velocity gradient (1/s).
    Tensor<2, dim>
    stress(const LocalIndex cell, const Tensor<2, dim> &gradient) const
    {
      const Tensor<1, dim> &n          = normal[cell];
      const double          divergence = trace(gradient), along_normal = n * (gradient * n);
      return part[cell] * ((2 * divergence - along_normal) * Tensor<2, dim>(unit_symmetric_tensor<dim>()) -
                           divergence * outer_product(n, n));
    }

  private:
    std::vector<double>         part; ///< of each cell; empty: none
    std::vector<Tensor<1, dim>> normal;
  };
} // namespace treacle

#endif
