// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/beyond_wall.h>
#include <treacle/surface/emitter_filling.h>

#include <boost/math/tools/minima.hpp>

#include <limits>

namespace treacle
{
  namespace
  {
    /// In leaves from emitters: farther off these do not go on into solids.
    constexpr double farthest = 5;

    /// What moves with the liquid is there but for what the velocity between nodes is off, a part of its way.
    constexpr double narrower = 0.01;

    /// What is as far from a surface (leaves) does not change it.
    constexpr double near = 0.5;

    /// To solids (m), as far as these matter.
    template <int dim>
    double
    to_solids(const Point<dim> &x, const Scene<dim> &scene, const double h, const double time)
    {
      return scene.solid_distance_within(x, AtWall::known * h, time);
    }

    /// How far a point is beyond the box or in a solid (m), negative in the open. What flows along a wall comes from it, not from beyond.
    template <int dim>
    double
    depth_beyond(const Point<dim> &x, const Scene<dim> &scene, const double h, const double time)
    {
      double depth = -to_solids(x, scene, h, time);
      for (unsigned int d = 0; d < dim; ++d)
        depth = std::max({depth, scene.lower_corner()[d] - x[d], x[d] - scene.upper_corner()[d]});
      return snapped(depth, scene.rounding());
    }

    /// Of a @p way (m) back from a point the part that lies before a wall; 1 if none is on it.
    template <int dim>
    double
    part_before_wall(const Point<dim>     &x,
                     const Tensor<1, dim> &way,
                     const Scene<dim>     &scene,
                     const double          h,
                     const double          time)
    {
      double     part = 1;
      const auto meet = [&](const double here, const double there) { // beyond one wall (m)
        if (snapped(there, scene.rounding()) > std::max(here, 0.))
          part = std::min(part, here < 0 ? here / (here - there) : 0);
      };
      for (unsigned int d = 0; d < dim; ++d)
        {
          meet(scene.lower_corner()[d] - x[d], scene.lower_corner()[d] - x[d] + way[d]);
          meet(x[d] - scene.upper_corner()[d], x[d] - way[d] - scene.upper_corner()[d]);
        }
      meet(-to_solids(x, scene, h, time), -to_solids<dim>(x - way, scene, h, time));
      return part;
    }
  } // namespace

  template <int dim>
  Distance<dim>
  distance_to_filled(const Scene<dim> &scene, const double h, const double time)
  {
    const Distance<dim> emitters = [&scene, time](const Point<dim> &x) { return scene.emitter_distance(x, time); };
    if (!scene.has_solids())
      return emitters;
    const Distance<dim> solids = [&scene, h, time](const Point<dim> &x) { return to_solids(x, scene, h, time); };
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
                                      const double      dt,
                                      const bool        cuts_skins)
    : scene(scene)
    , h(h)
    , time(time)
    , dt(dt)
    , farthest_way(16 * h) // more than any step allows
    , cuts_skins(cuts_skins)
    , filled(distance_to_filled(scene, h, time))
    , filled_before(distance_to_filled(scene, h, earlier))
  {}

  template <int dim>
  bool
  EmitterFilling<dim>::is_far(const double to_emitter, const Tensor<1, dim> &v) const
  {
    return to_emitter >= 2 * h + std::min(2 * dt * v.norm(), farthest_way);
  }

  template <int dim>
  double
  EmitterFilling<dim>::to_filled(const Point<dim> &x, const double to_emitter) const
  {
    return scene.has_solids() && to_emitter <= farthest * h ? filled(x) : to_emitter;
  }

  template <int dim>
  double
  EmitterFilling<dim>::swept(const Point<dim> &x, Tensor<1, dim> way, const double to_filled) const
  {
    if (!(way.norm() <= farthest_way) || to_filled > way.norm() + near * h)
      return to_filled;
    const double part   = part_before_wall(x, way, scene, h, time);
    way *= part;
    const double length = way.norm();
    if (!(length > 0))
      return to_filled;
    const auto at = [&](const double of_way) { return filled(x - of_way * way); };
    // a distance is convex along a line if its body is: most points are beside streams that flow on, where it is least at the end, and phi
    // what has come to be there, which may be less; but not where that would have come from beyond a wall, as beside half a ball at the
    // ceiling
    constexpr double step = 1e-3, flat = 0.05; // of the way; m/m
    const double     at_end = at(1), slope = (at_end - at(1 - step)) / (step * length),
                 lowest = std::max(at_end - slope * length, 0.5 * (to_filled + at_end - length));
    if ((std::abs(slope) < flat && (part == 1 || to_filled - at_end < flat * length)) || (part == 1 && slope < 0) || lowest > near * h)
      return to_filled;
    constexpr int        bits = 6; // of the way
    boost::uintmax_t     most = 10;
    return std::min(to_filled, boost::math::tools::brent_find_minima(at, 0., 1., bits, most).second + narrower * length);
  }

  template <int dim>
  double
  EmitterFilling<dim>::distance(const Point<dim> &x, const Tensor<1, dim> &v) const
  {
    const double here = to_filled(x, scene.emitter_distance(x, time));
    return is_far(here, v) ? here : swept(x, 0.5 * dt * (scene.emitter_velocity(x, time) + v), here);
  }

  template <int dim>
  double
  EmitterFilling<dim>::through_wall(const Point<dim> &x, const Tensor<1, dim> &way, const double depth) const
  {
    const double part = cuts_skins && depth > 0 ? part_before_wall(x, way, scene, h, time) : 1;
    return part == 1 ? std::numeric_limits<double>::lowest() : std::min(filled(x - part * way), depth);
  }

  template <int dim>
  bool
  EmitterFilling<dim>::is_skin(const Point<dim> &x, const Tensor<1, dim> &v, const double distance) const
  {
    constexpr double beside          = 0.05; // leaves
    const auto [emitter, to_emitter] = scene.nearest_emitter(x, time);
    if (distance < beside * h || is_far(to_emitter, v))
      return false;
    const Tensor<1, dim> way = dt * emitter->velocity(x, time);
    return through_wall(x, way, depth_beyond<dim>(x - way, scene, h, time)) > beside * h;
  }

  template <int dim>
  typename EmitterFilling<dim>::Phi
  EmitterFilling<dim>::phi(const Point<dim> &x, const double old, const Tensor<1, dim> &v) const
  {
    const auto [emitter, to_emitter] = scene.nearest_emitter(x, time);
    if (is_far(to_emitter, v)) // what flowed in is no other than what was there
      return {std::min(old, to_emitter), to_emitter, to_emitter, to_emitter};
    const Tensor<1, dim> way   = dt * emitter->velocity(x, time);
    const Point<dim>     from  = x - way;
    const double         depth = depth_beyond(from, scene, h, time), here = to_filled(x, to_emitter),
                 flowed = filled_before(from);
    // what flowed on from there has sharp edges here; what phi shows of it bulges beside them for their volume, as far as half a leaf. Outside
    // of emitters it has come to stay, and a stream that flows into one is none
    constexpr double most     = 0.1; // leaves
    const double     bulge    = here > 0 ? 0 : most * std::clamp(1.5 * h - 2 * flowed, 0., h);
    const double     before   = std::max(std::min(old + bulge, flowed), depth);
    const double     distance = before < 0 || here < -near * h ? here : swept(x, 0.5 * (way + dt * v), here);
    const double     remains  = old > -h ? std::max(old, through_wall(x, way, depth)) : old;
    // where walls bound both, neither has more
    const double inside = here > 0 && before < 0 ? before : std::max(distance, depth_beyond(x, scene, h, time));
    return {std::min(remains, distance), inside, std::max(inside, before), to_emitter};
  }

#define INSTANTIATE(dim)                                                                                 \
  template Distance<dim> distance_to_filled<dim>(const Scene<dim> &, const double, const double);        \
  template class EmitterFilling<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
