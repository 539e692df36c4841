// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_shape_parameters_h
#define treacle_geometry_shape_parameters_h

#include <treacle/base/types.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace treacle
{
  /// The point with the same value in all components.
  template <int dim>
  Point<dim>
  diagonal_point(const double value)
  {
    Point<dim> p;
    for (unsigned int d = 0; d < dim; ++d)
      p[d] = value;
    return p;
  }



  /// All shapes there are.
  enum class ShapeKind
  {
    sphere,
    box,
    cylinder,
    capsule,
    torus,
    half_space,
    triangle_mesh,
    expression
  };

  /// A body as a subsection of the parameter file describes it.
  template <int dim>
  struct ShapeParameters
  {
    ShapeKind      kind         = ShapeKind::sphere;
    bool           invert       = false;
    Point<dim>     centre       = diagonal_point<dim>(0.5);
    double         radius       = 0.2;
    double         minor_radius = 0.05;
    Tensor<1, dim> axis         = Point<dim>::unit_vector(dim - 1);
    double         length       = 0.4;
    Tensor<1, dim> normal       = Point<dim>::unit_vector(dim - 1);
    Point<dim>     lower_corner = diagonal_point<dim>(0.3);
    Point<dim>     upper_corner = diagonal_point<dim>(0.7);
    Point<dim>     start        = diagonal_point<dim>(0.4);
    Point<dim>     end          = diagonal_point<dim>(0.6);
    std::string    expression;

    std::string    file;
    bool           centre_at_origin = false;

    // the body is made with what is above, and put where this says
    double         scale          = 1;
    Tensor<1, dim> rotation_axis  = Point<dim>::unit_vector(dim - 1);
    double         rotation_angle = 0; // degrees
    Tensor<1, dim> translation;

    /// Declare in the current subsection; @p prm writes into this object when it parses.
    void
    add_parameters(ParameterHandler &prm);

  private:
    void
    add_plain_bodies(ParameterHandler &prm);

    void
    add_triangle_mesh(ParameterHandler &prm);

    void
    add_placement(ParameterHandler &prm);
  };
} // namespace treacle

#endif
