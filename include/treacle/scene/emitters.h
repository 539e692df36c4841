// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_emitters_h
#define treacle_scene_emitters_h

#include <treacle/scene/near_emitters.h>

namespace treacle
{
  /// The emitters of a scene, and the union of those at work.
  template <int dim>
  class Emitters
  {
  public:
    using Parameters = std::vector<typename Emitter<dim>::Parameters>;

    /// What their parameters leave out of a material is as in @p otherwise. Collective, for the
    /// first rank reads files.
    Emitters(const Parameters       &parameters,
             const Material<dim>    &otherwise,
             const BoundingBox<dim> &box,
             const MPI_Comm         &comm);

    const std::vector<Emitter<dim>> &
    emitters() const
    {
      return list;
    }

    /// Signed distance to the union of the emitters at work from t on, negative
    /// inside; a large number if there is none.
    double
    emitter_distance(const Point<dim> &x, const double t) const;

    /// Of the nearest emitter at work from t on (m/s); zero if there is none.
    Tensor<1, dim>
    emitter_velocity(const Point<dim> &x, const double t) const;

    /// The emitter at work from t on with the smallest distance, or null, and that
    /// distance.
    std::pair<const Emitter<dim> *, double>
    nearest_emitter(const Point<dim> &x, const double t) const;

    /// Smallest distance to the boundary of an emitter that has not stopped at t.
    double
    distance_to_emitter_boundary(const Point<dim> &x, const double t) const;

    /// The next time after t at which an emitter starts or stops (s).
    double
    next_switch(const double t) const;

    /// Does an emitter start or stop at t?
    bool
    has_switch_at(const double t) const;

  private:
    std::vector<Emitter<dim>> list;
    mutable NearEmitters<dim> near;
  };
} // namespace treacle

#endif
