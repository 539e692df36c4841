// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_beyond_wall_h
#define treacle_geometry_beyond_wall_h

#include <treacle/geometry/distance.h>

#include <deal.II/base/bounding_box.h>

namespace treacle
{
  /// In leaves: what is given as close to a wall as this touches it; how far from walls that is looked at, and their distance known.
  struct AtWall
  {
    static constexpr double touching = 0.1, reach = 4, known = 5;
  };

  /// The distance @p f (m) to liquid at @p x as if it went on beyond a wall @p s (m) from there where it touches that: what it has of the
  /// liquid's end at the wall is no surface. @p away (length 1) leads off the wall, @p h (m) is the edge of the leaves. Alike for
  /// all points before one point of the wall.
  template <int dim>
  double
  beyond_wall(const Distance<dim>  &f,
              const Point<dim>     &x,
              const double          s,
              const Tensor<1, dim> &away,
              const double          h);

  /// The same with bodies whose signed distance (m), near their walls, is @p solids; in them the distance goes on as it is before their wall.
  template <int dim>
  double
  beyond_solids(const Distance<dim> &f, const Distance<dim> &solids, const Point<dim> &x, const double h);

  /// The same with all sides of a box; outside of it that on the side.
  template <int dim>
  Distance<dim>
  beyond_sides(Distance<dim> f, const BoundingBox<dim> &box, const double h);
} // namespace treacle

#endif
