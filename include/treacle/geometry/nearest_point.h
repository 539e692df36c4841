// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_nearest_point_h
#define treacle_geometry_nearest_point_h

#include <treacle/base/types.h>

namespace treacle
{
  /// The point of a facet (2D: a segment, 3D: a triangle) that is nearest to p.
  Point<2>
  nearest_point(const std::array<Point<2>, 2> &facet, const Point<2> &p);

  Point<3>
  nearest_point(const std::array<Point<3>, 3> &facet, const Point<3> &p);
} // namespace treacle

#endif
