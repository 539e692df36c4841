// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_emitter_h
#define treacle_scene_emitter_h

#include <treacle/geometry/shapes.h>
#include <treacle/scene/material.h>

#include <deal.II/base/bounding_box.h>

namespace treacle
{
  /// A shape that is kept full of liquid moving at a given velocity while it is at
  /// work: from its start to its stop time.
  template <int dim>
  class Emitter
  {
  public:
    struct Parameters
    {
      typename Shape<dim>::Parameters    shape;
      std::string                        velocity   = dim == 2 ? "0; -1" : "0; 0; -1"; // m/s
      double                             start_time = 0;                               // s
      double                             stop_time  = 1e30;                            // s
      typename Material<dim>::Parameters material;

      /// Declare in the current subsection.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// @p where names the subsection in messages; what @p parameters leave out of the
    /// material is as in @p otherwise. Collective.
    Emitter(const Parameters       &parameters,
            const std::string      &where,
            const Material<dim>    &otherwise,
            const BoundingBox<dim> &box,
            const MPI_Comm         &comm);

    /// Negative inside (m). It goes on beyond the sides of the box that it reaches: a surface there would lie along the side, and
    /// liquid cover all of that.
    double
    signed_distance(const Point<dim> &x) const
    {
      return snapped(distance(x), rounding);
    }

    /// m/s. Throws a UserError where it is not finite.
    Tensor<1, dim>
    velocity(const Point<dim> &x, const double t) const;

    bool
    changes_velocity() const
    {
      return velocity_at.depends_on_time();
    }

    /// From t on?
    bool
    is_at_work(const double t) const
    {
      // steps end at these times, but for rounding
      return start_time <= t * (1 + 1e-12) && t * (1 + 1e-12) < stop_time;
    }

    const std::string   where;
    const Material<dim> material;
    const double        start_time, stop_time; // s
    const bool          is_formula;            ///< whose values need not be distances

  private:
    const double                rounding; // m
    const Distance<dim>         distance;
    const VectorExpression<dim> velocity_at;
  };
} // namespace treacle

#endif
