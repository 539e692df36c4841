// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_solid_h
#define treacle_scene_solid_h

#include <treacle/geometry/motion.h>
#include <treacle/geometry/shapes.h>

#include <deal.II/base/bounding_box.h>

namespace treacle
{
  /// An obstacle or container, at rest or in rigid motion.
  template <int dim>
  class Solid
  {
  public:
    struct Parameters
    {
      typename Shape<dim>::Parameters       shape;
      typename RigidMotion<dim>::Parameters motion;
      unsigned int                          level = 0; ///< of leaves with liquid beside it

      /// Declare in the current subsection.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// @p where names the subsection in messages. Collective.
    Solid(const Parameters       &parameters,
          const std::string      &where,
          const BoundingBox<dim> &box,
          const MPI_Comm         &comm);

    bool
    is_moving() const
    {
      return motion.is_moving();
    }

    /// Negative inside the solid (m).
    double
    signed_distance(const Point<dim> &x, const double t) const;

    /// See Shape.
    double
    distance_within(const Point<dim> &x, const double reach, const double t) const;

    /// See Shape.
    double
    least_distance(const Point<dim> &x, const double t) const;

    /// Of the solid's material at x (m/s).
    Tensor<1, dim>
    velocity(const Point<dim> &x, const double t) const;

    /// That leaves with liquid beside it must have; 0: any.
    unsigned int
    level() const
    {
      return level_beside;
    }

    /// Of its rotation (m).
    Point<dim>
    centre(const double t) const;

    /// Throws a UserError if its motion is not finite at t.
    void
    check(const double t) const;

  private:
    /// Where the material point that is at @p x at t was at t = 0.
    Point<dim>
    at_start(const Point<dim> &x, const double t) const;

    const Shape<dim>   shape;
    const unsigned int level_beside;
    RigidMotion<dim>   motion;
  };
} // namespace treacle

#endif
