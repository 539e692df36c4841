// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_shapes_h
#define treacle_geometry_shapes_h

#include <treacle/geometry/distance.h>
#include <treacle/geometry/shape_parameters.h>

namespace treacle
{
  /// Of a point (m) within a reach (m), see Shape::distance_within().
  template <int dim>
  using DistanceWithin = std::function<double(const Point<dim> &, double)>;

  /// A body that a subsection of the parameter file describes, known by its
  /// signed distance. Copies share what is large.
  template <int dim>
  class Shape
  {
  public:
    using Parameters = ShapeParameters<dim>;

    /// @p where names the subsection in messages, as in "Liquid 1"; distances (m) below
    /// @p rounding are none. Throws a UserError on all ranks where the parameters describe no such
    /// body. Collective, for the first rank reads files.
    Shape(const Parameters  &parameters,
          const std::string &where,
          const double       rounding,
          const MPI_Comm    &comm = MPI_COMM_SELF);

    /// Distance (m) to the boundary, negative inside. Exact but for rounding, and for
    /// expressions, which are what they are.
    double
    signed_distance(const Point<dim> &x) const
    {
      return snapped(sign * distance(x), rounding);
    }

    /// The same where the boundary is nearer than @p reach (m); else a number of its sign, no nearer than that, no farther than it is,
    /// which triangles tell sooner.
    double
    distance_within(const Point<dim> &x, const double reach) const
    {
      return snapped(sign * (within ? within(x, reach) : distance(x)), rounding);
    }

    /// Are they triangles with a known box around them?
    bool
    has_box() const
    {
      return within && sign > 0;
    }

    /// No more than the signed distance (m), known at once from that box.
    double
    least_distance(const Point<dim> &x) const
    {
      constexpr double nearly = 1 - 1e-12; // rounding must not make it more
      const double     to_box = has_box() ? nearly * within(x, 0) - rounding : 0;
      return to_box > rounding ? to_box : std::numeric_limits<double>::lowest();
    }

  private:
    double              sign, rounding; // -, m
    Distance<dim>       distance;
    DistanceWithin<dim> within; ///< none where that is no cheaper
  };
} // namespace treacle

#endif
