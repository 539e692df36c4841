// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_marker_h
#define treacle_fields_marker_h

#include <treacle/geometry/distance.h>

#include <array>

namespace treacle
{
  /// A massless point on the surface. It remembers where the surface is better than
  /// phi does, and its normal which side of it is liquid.
  template <int dim>
  struct Marker
  {
    Point<dim>     position; ///< m
    Tensor<1, dim> normal;   ///< unit, out of the liquid

    /// For files and messages: position, then normal.
    using Numbers = std::array<double, 2 * dim>;

    Numbers
    numbers() const
    {
      Numbers n;
      for (unsigned int d = 0; d < dim; ++d)
        {
          n[d]       = position[d];
          n[dim + d] = normal[d];
        }
      return n;
    }

    static Marker
    from(const double *n)
    {
      Marker marker;
      for (unsigned int d = 0; d < dim; ++d)
        {
          marker.position[d] = n[d];
          marker.normal[d]   = n[dim + d];
        }
      return marker;
    }
  };

  /// On the surface of a body whose distance is @p distance, where it is nearest to @p x (to first order, by differences over
  /// +-d, m). Not a number where that has no gradient.
  template <int dim>
  Marker<dim>
  marker_on(const Distance<dim> &distance, const Point<dim> &x, const double d)
  {
    const Tensor<1, dim> gradient = gradient_of<dim>(distance, x, d);
    return {x - distance(x) / gradient.norm_square() * gradient, gradient / gradient.norm()};
  }
} // namespace treacle

#endif
