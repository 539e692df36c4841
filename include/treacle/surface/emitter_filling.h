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
    /// Full a time of @p dt before were the emitters that worked @p earlier; h is the finest leaf.
    EmitterFilling(const Scene<dim> &scene, const double h, const double time, const double earlier, const double dt);

    struct Phi
    {
      double after;
      double inside; ///< emitters, up to walls
      double kept;   ///< inside, what came from there or was there already
    };

    /// Paths that lead back through a wall bring none: what sticks to the ceiling beside an emitter, as a skin
    /// of it, must not become a second one.
    Phi
    phi(const Point<dim> &x, const double old) const;

  private:
    const Scene<dim> &scene;
    const double      h, time, dt;
    Distance<dim>     filled, filled_before;
  };
} // namespace treacle

#endif
