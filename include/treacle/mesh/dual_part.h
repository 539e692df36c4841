// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_dual_part_h
#define treacle_mesh_dual_part_h

#include <treacle/base/types.h>

namespace treacle
{
  /// A part of a dual edge.
  template <int dim>
  struct DualPart
  {
    Point<dim>     begin;
    Tensor<1, dim> way; ///< to its end

    /// At a part of the way.
    Point<dim>
    at(const double part) const
    {
      return begin + part * way;
    }

    /// Of a function of places, by two points after Gauss.
    template <typename Function>
    auto
    mean(const Function &f) const
    {
      const double to_point = 0.5 / std::sqrt(3.);
      return 0.5 * (f(at(0.5 - to_point)) + f(at(0.5 + to_point)));
    }
  };
} // namespace treacle

#endif
