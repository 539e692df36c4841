// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_distance_h
#define treacle_geometry_distance_h

#include <treacle/base/types.h>

#include <functional>

namespace treacle
{
  /// Of a point (m), negative in a body.
  template <int dim>
  using Distance = std::function<double(const Point<dim> &)>;

  /// By differences over +-d (m); that of a formula need not have length 1.
  template <int dim>
  Tensor<1, dim>
  gradient_of(const Distance<dim> &distance, const Point<dim> &x, const double d)
  {
    Tensor<1, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      {
        const Tensor<1, dim> along = d * Point<dim>::unit_vector(a);
        result[a]                  = distance(x + along) / (2 * d) - distance(x - along) / (2 * d);
      }
    return result;
  }
} // namespace treacle

#endif
