// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_nearest_point_h
#define treacle_geometry_nearest_point_h

#include <treacle/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>

namespace treacle
{
  /// The point of a facet (2D: a segment, 3D: a triangle) that is nearest to p.
  Point<2>
  nearest_point(const std::array<Point<2>, 2> &facet, const Point<2> &p);

  Point<3>
  nearest_point(const std::array<Point<3>, 3> &facet, const Point<3> &p);

  /// The point of a box that is nearest to p.
  template <int dim>
  Point<dim>
  nearest_point(const BoundingBox<dim> &box, Point<dim> p)
  {
    for (unsigned int d = 0; d < dim; ++d)
      p[d] = std::min(std::max(p[d], box.lower_bound(d)), box.upper_bound(d));
    return p;
  }
} // namespace treacle

#endif
