// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/scene/solid.h>

namespace treacle
{
  template <int dim>
  void
  Solid<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    shape.add_parameters(prm);
    motion.add_parameters(prm);
    prm.add_parameter("Level",
                      level,
                      "Smallest level of the leaves of liquid along the solid, whether or not the "
                      "surface is near; at most Mesh/Surface level.",
                      Patterns::Integer(0, 18));
  }

  namespace
  {
    /// A grid of points of the box, 33 in each direction.
    template <int dim>
    std::vector<Point<dim>>
    grid(const BoundingBox<dim> &box)
    {
      constexpr unsigned int  n = 33;
      std::vector<Point<dim>> points;
      for (unsigned int k = 0; k < (dim == 2 ? n * n : n * n * n); ++k)
        {
          Point<dim>   x;
          unsigned int code = k;
          for (unsigned int d = 0; d < dim; ++d, code /= n)
            x[d] = box.lower_bound(d) + (code % n) * box.side_length(d) / (n - 1.);
          points.push_back(x);
        }
      return points;
    }
  } // namespace

  template <int dim>
  Solid<dim>::Solid(const Parameters       &prm,
                    const std::string      &where,
                    const BoundingBox<dim> &box,
                    const MPI_Comm         &comm)
    : box(box)
    , shape(prm.shape, where, rounding_in(box), comm)
    , level_beside(prm.level)
    , motion(prm.motion, where)
  {
    if (!motion.is_moving())
      return;
    const Pose<dim> &pose = motion.at(0);
    for (const Point<dim> &x : grid(box))
      if (shape.signed_distance(pose.at_start(x)) < 0)
        sample.push_back(pose.at_start(x));
    // what is smaller than the grid
    if (sample.empty() && box.point_inside(pose.now(prm.shape.centre)) &&
        shape.signed_distance(prm.shape.centre) < 0)
      sample.push_back(prm.shape.centre);
  }

  template <int dim>
  double
  Solid<dim>::signed_distance(const Point<dim> &x, const double t) const
  {
    return shape.signed_distance(at_start(x, t));
  }

  template <int dim>
  double
  Solid<dim>::distance_within(const Point<dim> &x, const double reach, const double t) const
  {
    return shape.distance_within(at_start(x, t), reach);
  }

  template <int dim>
  double
  Solid<dim>::least_distance(const Point<dim> &x, const double t) const
  {
    return shape.has_box() ? shape.least_distance(at_start(x, t)) : std::numeric_limits<double>::lowest();
  }

  template <int dim>
  Point<dim>
  Solid<dim>::at_start(const Point<dim> &x, const double t) const
  {
    return motion.is_moving() ? motion.at(t).at_start(x) : x;
  }

  template <int dim>
  Tensor<1, dim>
  Solid<dim>::velocity(const Point<dim> &x, const double t) const
  {
    return motion.is_moving() ? motion.at(t).velocity_at(x) : Tensor<1, dim>();
  }

  template <int dim>
  Point<dim>
  Solid<dim>::centre(const double t) const
  {
    const Pose<dim> &pose = motion.at(t);
    return pose.start + pose.shift;
  }

  template <int dim>
  void
  Solid<dim>::check(const double t) const
  {
    if (motion.is_moving())
      motion.at(t);
  }

  template <int dim>
  bool
  Solid<dim>::has_left(const double t) const
  {
    if (!motion.is_moving())
      return false;
    const Pose<dim> &pose      = motion.at(t);
    const auto       is_in_box = [&](const Point<dim> &x) { return box.point_inside(pose.now(x)); };
    if (sample.empty() || std::any_of(sample.begin(), sample.end(), is_in_box))
      return false;
    // others than those of the start may be: a half space is a belt
    const std::vector<Point<dim>> points = grid(box);
    return std::none_of(points.begin(), points.end(), [&](const Point<dim> &x) { return signed_distance(x, t) < 0; });
  }

  template class Solid<2>;
  template class Solid<3>;
} // namespace treacle
