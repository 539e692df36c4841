// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/surface/emitter_filling.h>

namespace treacle
{
  namespace
  {
    /// How far a point is beyond the box or in a solid (m), negative in the open.
    template <int dim>
    double
    depth_beyond(const Point<dim> &x, const Scene<dim> &scene, const double time)
    {
      double depth = -scene.solid_distance(x, time);
      for (unsigned int d = 0; d < dim; ++d)
        depth = std::max({depth, scene.lower_corner()[d] - x[d], x[d] - scene.upper_corner()[d]});
      return depth;
    }

    template <int dim>
    Point<dim>
    in_box(Point<dim> x, const Scene<dim> &scene)
    {
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::min(std::max(x[d], scene.lower_corner()[d]), scene.upper_corner()[d]);
      return x;
    }
  } // namespace

  template <int dim>
  typename EmitterFilling<dim>::Phi
  EmitterFilling<dim>::phi(const Point<dim> &x, const double old) const
  {
    const double distance = scene.emitter_distance(x, time);
    if (distance >= 2 * h) // what flowed in is no other than what was there
      return {std::min(old, distance), distance, distance};
    const Point<dim> from  = x - dt * scene.emitter_velocity(x, time);
    const double     depth = depth_beyond(from, scene, time);
    // what flowed on from there has sharp edges here; what phi shows of it bulges beside them for their volume
    constexpr double bulge  = 0.1; // leaves
    const double     before = std::max(std::min(old + bulge * h, scene.emitter_distance(from, earlier)), depth);
    const bool       is_skin =
      depth > 0 && old > -h && scene.emitter_distance(in_box(from, scene), time) > 0;
    return {std::min(is_skin ? std::max(old, depth) : old, distance),
            distance,
            std::max(distance, before)};
  }

  template class EmitterFilling<2>;
  template class EmitterFilling<3>;
} // namespace treacle
