// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/beyond_wall.h>
#include <treacle/surface/emitter_filling.h>

namespace treacle
{
  namespace
  {
    /// In leaves from emitters: farther off these do not go on into solids.
    constexpr double farthest = 5;

    /// How far a point is beyond the box or in a solid (m), negative in the open. What flows along a wall comes from it, not from beyond.
    template <int dim>
    double
    depth_beyond(const Point<dim> &x, const Scene<dim> &scene, const double time)
    {
      double depth = -scene.solid_distance(x, time);
      for (unsigned int d = 0; d < dim; ++d)
        depth = std::max({depth, scene.lower_corner()[d] - x[d], x[d] - scene.upper_corner()[d]});
      return snapped(depth, scene.rounding());
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
  Distance<dim>
  distance_to_filled(const Scene<dim> &scene, const double h, const double time)
  {
    const Distance<dim> emitters = [&scene, time](const Point<dim> &x) { return scene.emitter_distance(x, time); };
    if (!scene.has_solids())
      return emitters;
    const Distance<dim> solids = [&scene, time](const Point<dim> &x) { return scene.solid_distance(x, time); };
    // outside of emitters only what is in solids changes, near their walls
    return [emitters, solids, h, rounding = scene.rounding()](const Point<dim> &x) {
      const double distance = emitters(x);
      return distance > farthest * h ? distance : snapped(beyond_solids<dim>(emitters, solids, x, h), rounding);
    };
  }

  template <int dim>
  EmitterFilling<dim>::EmitterFilling(const Scene<dim> &scene,
                                      const double      h,
                                      const double      time,
                                      const double      earlier,
                                      const double      dt)
    : scene(scene)
    , h(h)
    , time(time)
    , dt(dt)
    , filled(distance_to_filled(scene, h, time))
    , filled_before(distance_to_filled(scene, h, earlier))
  {}

  template <int dim>
  typename EmitterFilling<dim>::Phi
  EmitterFilling<dim>::phi(const Point<dim> &x, const double old) const
  {
    const auto [emitter, to_emitter] = scene.nearest_emitter(x, time);
    const double distance            = scene.has_solids() && to_emitter <= farthest * h ? filled(x) : to_emitter;
    if (distance >= 2 * h) // what flowed in is no other than what was there
      return {std::min(old, distance), distance, distance};
    const Point<dim> from  = x - dt * emitter->velocity(x, time);
    const double     depth = depth_beyond(from, scene, time);
    // what flowed on from there has sharp edges here; what phi shows of it bulges beside them for their volume
    constexpr double bulge  = 0.1; // leaves
    const double     before = std::max(std::min(old + bulge * h, filled_before(from)), depth);
    const bool       is_skin =
      depth > 0 && old > -h && filled(in_box(from, scene)) > 0;
    const double inside = std::max(distance, depth_beyond(x, scene, time)); // where walls bound both, neither has more
    return {std::min(is_skin ? std::max(old, depth) : old, distance), inside, std::max(inside, before)};
  }

#define INSTANTIATE(dim)                                                                                 \
  template Distance<dim> distance_to_filled<dim>(const Scene<dim> &, const double, const double);        \
  template class EmitterFilling<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
