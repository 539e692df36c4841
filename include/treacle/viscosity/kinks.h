// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_kinks_h
#define treacle_viscosity_kinks_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Velocity in cells in which the viscosity jumps. On a plane with the normal n across which it jumps liquid that slides has the same stress on both
  /// sides, so velocity has a kink there. In a cell it is
  ///
  ///   v + a psi,   psi = |d| - I |d|,   n·a = 0,
  ///
  /// v and I |d| P1, d the distance from the plane, so psi is zero at the nodes, and a belongs to the cell: the one with which the two shear
  /// stresses are the same (an immersed finite element; Li, Lin & Wu 2003, doi:10.1007/s00211-003-0473-x, for scalars). Along n there is no kink, for the
  /// divergence of what moves along the plane is the same on both sides. Energy is that of this velocity, exact for what slides in layers.
  template <int dim>
  class Kinks
  {
  public:
    /// None.
    Kinks() = default;

    /// With the weight of 2 e : e in the cells, of which each has one viscosity. None in cells without pressure, where there may be a skin.
    Kinks(const LiquidDomain<dim> &domain, const std::vector<double> &weight);

    /// Is a cell one of these?
    bool
    has(const LocalIndex cell) const
    {
      return !index.empty() && index[cell] != invalid;
    }

    /// What comes to the second variation of a cell's energy, for gradients of the weights of two nodes (1/m): row of
    /// the first, column of the second.
    Tensor<2, dim>
    block(const LocalIndex cell, const Tensor<1, dim> &g, const Tensor<1, dim> &other) const
    {
      Tensor<2, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Tensor<2, dim> gradient;
          gradient[d]                  = other;
          const Tensor<1, dim> column = stress(cell, gradient) * g;
          for (unsigned int k = 0; k < dim; ++k)
            result[k][d] = column[k];
        }
      return result;
    }

    /// What comes to the cell's stress, times volume and step, of a velocity gradient (1/s); it does work on the kink as well.
    Tensor<2, dim>
    stress(const LocalIndex cell, const Tensor<2, dim> &gradient) const;

  private:
    struct Side
    {
      double         weight;   ///< of 2 e : e
      Tensor<1, dim> gradient; ///< of psi
    };

    struct Kink
    {
      std::array<Side, 2> sides;
      double              weight; ///< of 2 e : e in the cell with one viscosity
      Tensor<1, dim>      normal;
      double              slope; ///< a over what 2 e n has across n
    };

    std::vector<LocalIndex> index; ///< of each cell; empty: none
    std::vector<Kink>       kinks;
  };
} // namespace treacle

#endif
