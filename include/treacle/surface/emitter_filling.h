// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_emitter_filling_h
#define treacle_surface_emitter_filling_h

#include <treacle/scene/scene.h>

namespace treacle
{
  /// The distance (m) to what emitters at work from @p time on fill: they go on in solids whose walls they touch, as liquid does; a
  /// surface there would lie along the wall.
  template <int dim>
  Distance<dim>
  distance_to_filled(const Scene<dim> &scene, const double h, const double time);

  /// How emitters change phi in a step, which is old at a point once what was there has moved.
  template <int dim>
  class EmitterFilling
  {
  public:
    /// Full a time of @p dt before were the emitters that worked @p earlier; h is the finest leaf. Is what came through a wall cut off?
    EmitterFilling(const Scene<dim> &scene, const double h, const double time, const double earlier, const double dt, const bool cuts_skins);

    struct Phi
    {
      double after;
      double inside; ///< of what emitters have filled, up to walls
      double kept;   ///< inside, what came from there or was there already
      double to_emitters; ///< distance to these alone (m)
    };

    /// Where the liquid has the velocity @p v (m/s). Paths that lead back through a wall bring none: what sticks to the ceiling beside an
    /// emitter, as a skin of it, must not become a second one.
    Phi
    phi(const Point<dim> &x, const double old, const Tensor<1, dim> &v) const;

    /// Would what is there, with a velocity @p v (m/s) and at a distance() that is known, have come through a wall beside emitters, had
    /// it their velocity?
    bool
    is_skin(const Point<dim> &x, const Tensor<1, dim> &v, const double distance) const;

    /// To what emitters fill, or have filled on the way of their liquid in this time: one that is moved askew is more than where it
    /// begins and ends, and its liquid would have notches there, step by step.
    double
    distance(const Point<dim> &x, const Tensor<1, dim> &v) const;

  private:
    /// Is nothing filled so far from an emitter (m), where the liquid has this velocity? It was not twice as fast when it came out.
    bool
    is_far(const double to_emitter, const Tensor<1, dim> &v) const;

    /// phi of what came through a wall, a @p way (m) to a point, from a @p depth (m) beyond: that of emitters where it passed, but no
    /// more than this. The lowest number where no wall is on the way.
    double
    through_wall(const Point<dim> &x, const Tensor<1, dim> &way, const double depth) const;

    /// To emitters alone, where a point is at a distance @p to_emitter from them.
    double
    to_filled(const Point<dim> &x, const double to_emitter) const;

    /// See distance(); of a @p way (m) in the time, as far as no wall is on it.
    double
    swept(const Point<dim> &x, Tensor<1, dim> way, const double to_filled) const;

    const Scene<dim> &scene;
    const double      h, time, dt, farthest_way;
    const bool        cuts_skins;
    Distance<dim>     filled, filled_before;
  };
} // namespace treacle

#endif
