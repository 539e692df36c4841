// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_shapes_h
#define treacle_geometry_shapes_h

#include <treacle/base/types.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
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



  /// A body that a subsection of the parameter file describes, known by its
  /// signed distance. Copies share what is large.
  template <int dim>
  class Shape
  {
  public:
    using Distance = std::function<double(const Point<dim> &)>;

    struct Parameters
    {
      std::string    shape        = "sphere";
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
      double         scale            = 1;
      Tensor<1, dim> rotation_axis    = Point<dim>::unit_vector(dim - 1);
      double         rotation_angle   = 0; // degrees
      Tensor<1, dim> translation;

      /// Declare in the current subsection.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// @p where names the subsection in messages, as in "Liquid 1". Throws a
    /// UserError where the parameters describe no such body.
    Shape(const Parameters &parameters, const std::string &where);

    /// Distance (m) to the boundary, negative inside. Exact, but for
    /// expressions, which are what they are.
    double
    signed_distance(const Point<dim> &x) const
    {
      return sign * distance(x);
    }

  private:
    double   sign;
    Distance distance;
  };
} // namespace treacle

#endif
