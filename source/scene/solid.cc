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

  template <int dim>
  Solid<dim>::Solid(const Parameters       &prm,
                    const std::string      &where,
                    const BoundingBox<dim> &box,
                    const MPI_Comm         &comm)
    : shape(prm.shape, where, rounding_in(box), comm)
    , level_beside(prm.level)
    , motion(prm.motion, where)
  {}

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

  template class Solid<2>;
  template class Solid<3>;
} // namespace treacle
