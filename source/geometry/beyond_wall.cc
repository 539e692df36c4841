// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/beyond_wall.h>

#include <algorithm>

namespace treacle
{
  template <int dim>
  double
  beyond_wall(const Distance<dim>  &f,
              const Point<dim>     &x,
              const double          s,
              const Tensor<1, dim> &away,
              const double          h)
  {
    const double value      = f(x);
    const auto   at         = [&](const double from_wall) { return f(x + (from_wall - s) * away); };
    const auto   is_to_wall = [&](const double from_wall, const double phi) {
      constexpr double small = 0.05; // leaves
      return std::abs(phi + from_wall) < AtWall::touching * h && at(from_wall + small * h) - phi < -0.9 * small * h;
    };
    if (s > AtWall::reach * h || !is_to_wall(s, value))
      return value;
    // the free surface goes on straight
    for (const double way : {0.5 * h, h, 2 * h, 4 * h})
      {
        const double near = at(way), far = at(2 * way);
        if (!is_to_wall(way, near) && !is_to_wall(2 * way, far))
          return std::min(value, near + (1 - s / way) * (near - far));
      }
    return std::min(value, at(AtWall::reach * h));
  }

  template <int dim>
  double
  beyond_solids(const Distance<dim> &f, const Distance<dim> &solids, const Point<dim> &x, const double h)
  {
    // leaves; a formula's distance may be too long
    constexpr double farthest = 20, into_solids = 3;
    const double     phi      = f(x);
    if (phi < -(AtWall::reach + AtWall::touching) * h || phi > farthest * h)
      return phi;
    const double s = solids(x);
    if (s > AtWall::reach * h || (s < 0 ? phi <= 0 : phi > AtWall::touching * h))
      return phi;
    const Tensor<1, dim> gradient = gradient_of<dim>(solids, x, 0.01 * h);
    const double         slope    = gradient.norm();
    if (!(slope > 0))
      return phi;
    const Tensor<1, dim> away   = gradient / slope;
    const auto           before = [&](const double way) {
      return beyond_wall<dim>(f, x + (way - s / slope) * away, way, away, h);
    };
    if (s >= 0)
      return before(s / slope);
    const double depth = -s / slope;
    if (depth > into_solids * h || f(x + (depth + AtWall::touching * h) * away) >= 0)
      return phi;
    const double near = before(0.5 * depth), far = before(depth);
    return std::min(phi, near + 3 * (near - far));
  }

  template <int dim>
  Distance<dim>
  beyond_sides(Distance<dim> f, const BoundingBox<dim> &box, const double h)
  {
    for (unsigned int d = 0; d < dim; ++d)
      f = [f, d, h, lower = box.lower_bound(d), upper = box.upper_bound(d)](Point<dim> x) {
        x[d]              = std::min(std::max(x[d], lower), upper);
        const bool is_low = x[d] - lower < upper - x[d];
        return beyond_wall<dim>(f,
                                x,
                                is_low ? x[d] - lower : upper - x[d],
                                (is_low ? 1. : -1.) * Point<dim>::unit_vector(d),
                                h);
      };
    return f;
  }

#define INSTANTIATE(dim)                                                                                             \
  template double beyond_wall<dim>(                                                                                  \
    const Distance<dim> &, const Point<dim> &, const double, const Tensor<1, dim> &, const double);                  \
  template double beyond_solids<dim>(                                                                                \
    const Distance<dim> &, const Distance<dim> &, const Point<dim> &, const double);                                 \
  template Distance<dim> beyond_sides<dim>(Distance<dim>, const BoundingBox<dim> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
