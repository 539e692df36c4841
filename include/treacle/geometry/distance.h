// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_distance_h
#define treacle_geometry_distance_h

#include <treacle/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <functional>
#include <limits>

namespace treacle
{
  /// Of a point (m), negative in a body.
  template <int dim>
  using Distance = std::function<double(const Point<dim> &)>;

  /// How far (m) rounding may take points and distances in a box.
  template <int dim>
  double
  rounding_in(const BoundingBox<dim> &box)
  {
    constexpr double part_of_side = 1e-12, part_of_coordinate = 16 * std::numeric_limits<double>::epsilon();
    double           result       = 0;
    for (unsigned int d = 0; d < dim; ++d)
      result = std::max({result,
                         part_of_side * box.side_length(d),
                         part_of_coordinate * std::abs(box.lower_bound(d)),
                         part_of_coordinate * std::abs(box.upper_bound(d))});
    return result;
  }

  /// A boundary along nodes is one, whatever rounding says.
  inline double
  snapped(const double distance, const double rounding)
  {
    return std::abs(distance) < rounding ? 0. : distance;
  }

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
