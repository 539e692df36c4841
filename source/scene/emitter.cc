// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/beyond_wall.h>
#include <treacle/scene/emitter.h>

namespace treacle
{
  template <int dim>
  void
  Emitter<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    shape.add_parameters(prm);
    prm.add_parameter("Velocity",
                      velocity,
                      std::string("Of the liquid inside (m/s); a formula in ") +
                        (dim == 2 ? "x,y,t" : "x,y,z,t") +
                        " per component, separated by semicolons. Where it converges, or goes out through a wall, liquid is taken away.");
    prm.add_parameter("Start time", start_time, "When it begins to emit (s).");
    prm.add_parameter("Stop time", stop_time, "When it ends (s).");
    material.add_parameters(prm, "; as in Material if empty (Transport = advected).");
  }

  namespace
  {
    /// No leaves are known here: those of the default level.
    template <int dim>
    Distance<dim>
    beyond_sides_of(const BoundingBox<dim> &box, const Shape<dim> &shape)
    {
      double shortest = box.side_length(0);
      for (unsigned int d = 1; d < dim; ++d)
        shortest = std::min(shortest, box.side_length(d));
      return beyond_sides<dim>([shape](const Point<dim> &x) { return shape.signed_distance(x); }, box, shortest / 64);
    }
  } // namespace

  template <int dim>
  Emitter<dim>::Emitter(const Parameters       &prm,
                        const std::string      &where,
                        const Material<dim>    &otherwise,
                        const BoundingBox<dim> &box,
                        const MPI_Comm         &comm)
    : where(where)
    , material(prm.material, where, &otherwise)
    , start_time(prm.start_time)
    , stop_time(prm.stop_time)
    , is_formula(prm.shape.kind == ShapeKind::expression)
    , rounding(rounding_in(box))
    , distance(beyond_sides_of(box, Shape<dim>(prm.shape, where, rounding, comm)))
    , velocity_at(prm.velocity, where + "/Velocity")
  {
    require(start_time < stop_time, where + "/Stop time must be later than its Start time.");
  }

  template <int dim>
  Tensor<1, dim>
  Emitter<dim>::velocity(const Point<dim> &x, const double t) const
  {
    const Tensor<1, dim> value = velocity_at(x, t);
    if (!std::isfinite(value.norm_square()))
      value_error(where + "/Velocity", value.norm(), "finite", x, t);
    return value;
  }

  template class Emitter<2>;
  template class Emitter<3>;
} // namespace treacle
