// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_wetted_walls_h
#define treacle_fields_wetted_walls_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// What the liquid of a cell wets of a wall: of a side of the mesh, or of the solid that cuts the cell. A P1 function is, in the mean over
  /// it, the sum of its values at the cell's nodes times their weights.
  template <int dim>
  struct WettedWall
  {
    VertexValues<dim> weight; ///< of the nodes, at the centroid
    Tensor<1, dim>    area;   ///< (m^(dim-1)), out of the liquid
    double            swept;  ///< what the wall itself sweeps, that way (m^dim/s)

    /// Over the wall, of what has a @p value (i) at the nodes of the cell.
    template <typename Value>
    auto
    mean(const Value &value) const
    {
      auto sum = weight[0] * value(0);
      for (unsigned int i = 1; i <= dim; ++i)
        sum += weight[i] * value(i);
      return sum;
    }
  };

  /// All in a cell. With the liquid's surface they bound its volume, but for what is cut of sides by solids. Throws a UserError where a
  /// solid's velocity makes no sense.
  template <int dim>
  std::vector<WettedWall<dim>>
  wetted_walls(const LiquidDomain<dim> &domain, const State<dim> &state, const LocalIndex cell);
} // namespace treacle

#endif
