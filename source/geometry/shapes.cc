// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/expression.h>
#include <treacle/geometry/shapes.h>
#include <treacle/geometry/triangle_surface.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

namespace treacle
{
  namespace
  {
    void
    require_positive(const double       value,
                     const std::string &where,
                     const std::string &name)
    {
      std::ostringstream message;
      message << where << ": " << name << " is " << value
              << ", but must be positive and finite.";
      require(value > 0 && std::isfinite(value), message.str());
    }

    template <int dim>
    Tensor<1, dim>
    unit_vector(const Tensor<1, dim> &v,
                const std::string    &where,
                const std::string    &name)
    {
      const double norm = v.norm();
      require(norm > 0 && std::isfinite(norm),
              where + ": " + name + " must be a vector other than zero.");
      return v / norm;
    }

    /// Distance to a box centred at 0 in the coordinates x.
    template <int n>
    double
    box_distance(const Tensor<1, n> &x, const Tensor<1, n> &half_width)
    {
      double outside = 0, inside = -std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < n; ++d)
        {
          const double beyond = std::abs(x[d]) - half_width[d];
          outside += std::pow(std::max(beyond, 0.), 2);
          inside = std::max(inside, beyond);
        }
      return outside > 0 ? std::sqrt(outside) : inside;
    }

    /// Components of x along the unit vector axis and (a length) across it.
    template <int dim>
    Tensor<1, 2>
    along_and_across(const Tensor<1, dim> &x, const Tensor<1, dim> &axis)
    {
      Tensor<1, 2> result;
      result[0] = x * axis;
      result[1] = (x - result[0] * axis).norm();
      return result;
    }

    template <int dim>
    using Parameters = typename Shape<dim>::Parameters;
    template <int dim>
    using Distance = typename Shape<dim>::Distance;



    template <int dim>
    Distance<dim>
    sphere(const Parameters<dim> &p, const std::string &where)
    {
      require_positive(p.radius, where, "Radius");
      return [centre = p.centre, radius = p.radius](const Point<dim> &x) {
        return (x - centre).norm() - radius;
      };
    }

    template <int dim>
    Distance<dim>
    box(const Parameters<dim> &p, const std::string &where)
    {
      const Tensor<1, dim> half_width = 0.5 * (p.upper_corner - p.lower_corner);
      for (unsigned int d = 0; d < dim; ++d)
        require(half_width[d] > 0,
                where + ": Upper corner must exceed Lower corner in every component.");
      return [centre = p.lower_corner + half_width, half_width](const Point<dim> &x) {
        return box_distance<dim>(x - centre, half_width);
      };
    }

    template <int dim>
    Distance<dim>
    cylinder(const Parameters<dim> &p, const std::string &where)
    {
      require_positive(p.radius, where, "Radius");
      require_positive(p.length, where, "Length");
      Tensor<1, 2> half_width;
      half_width[0] = p.length / 2;
      half_width[1] = p.radius;
      return [centre = p.centre, axis = unit_vector(p.axis, where, "Axis"), half_width](
               const Point<dim> &x) {
        return box_distance<2>(along_and_across<dim>(x - centre, axis), half_width);
      };
    }

    template <int dim>
    Distance<dim>
    capsule(const Parameters<dim> &p, const std::string &where)
    {
      require_positive(p.radius, where, "Radius");
      const Tensor<1, dim> segment = p.end - p.start;
      const double         square  = segment.norm_square();
      return [start = p.start, segment, square, radius = p.radius](const Point<dim> &x) {
        const double t =
          square > 0 ? std::clamp((x - start) * segment / square, 0., 1.) : 0.;
        return (x - start - t * segment).norm() - radius;
      };
    }

    // In 2D the axis is normal to the plane and the torus is an annulus.
    template <int dim>
    Distance<dim>
    torus(const Parameters<dim> &p, const std::string &where)
    {
      require_positive(p.radius, where, "Radius");
      require_positive(p.minor_radius, where, "Minor radius");
      require(p.minor_radius < p.radius,
              where + ": Minor radius must be smaller than Radius.");
      const Tensor<1, dim> axis =
        (dim == 3 ? unit_vector(p.axis, where, "Axis") : Tensor<1, dim>());
      return [centre = p.centre, axis, radius = p.radius, minor_radius = p.minor_radius](
               const Point<dim> &x) {
        const Tensor<1, 2> r = along_and_across<dim>(x - centre, axis);
        return std::hypot(r[0], r[1] - radius) - minor_radius;
      };
    }

    template <int dim>
    Distance<dim>
    half_space(const Parameters<dim> &p, const std::string &where)
    {
      return [centre = p.centre, normal = unit_vector(p.normal, where, "Normal")](
               const Point<dim> &x) { return (x - centre) * normal; };
    }

    template <int dim>
    Distance<dim>
    triangle_mesh(const Parameters<dim> &p, const std::string &where)
    {
      require(dim == 3,
              where + ": the shape \"triangle mesh\" is for Dimension = 3; in 2D use "
                      "another shape or an expression.");
      require(!p.file.empty(),
              where + ": File is empty, but must name an OFF, OBJ, PLY or STL file.");
      require_positive(p.scale, where, "Scale");

      if constexpr (dim == 3)
        {
          Placement placement;
          placement.centre_at_origin = p.centre_at_origin;
          placement.scale            = p.scale;
          placement.axis        = unit_vector(p.rotation_axis, where, "Rotation axis");
          placement.angle       = p.rotation_angle * numbers::PI / 180;
          placement.translation = p.translation;

          const auto surface =
            std::make_shared<const TriangleSurface>(p.file, placement, where + "/File");
          return [surface](const Point<3> &x) { return surface->signed_distance(x); };
        }
      else
        return {};
    }

    template <int dim>
    Distance<dim>
    expression(const Parameters<dim> &p, const std::string &where)
    {
      return Expression<dim>(p.expression, where + "/Expression", false);
    }



    template <int dim>
    using Maker = Distance<dim> (*)(const Parameters<dim> &, const std::string &);

    /// All shapes there are.
    template <int dim>
    const std::vector<std::pair<std::string, Maker<dim>>> &
    shapes()
    {
      static const std::vector<std::pair<std::string, Maker<dim>>> list = {
        {"sphere", &sphere<dim>},
        {"box", &box<dim>},
        {"cylinder", &cylinder<dim>},
        {"capsule", &capsule<dim>},
        {"torus", &torus<dim>},
        {"half space", &half_space<dim>},
        {"triangle mesh", &triangle_mesh<dim>},
        {"expression", &expression<dim>}};
      return list;
    }

    template <int dim>
    std::string
    shape_names(const std::string &separator)
    {
      std::string names;
      for (const auto &shape : shapes<dim>())
        names += (names.empty() ? "" : separator) + shape.first;
      return names;
    }
  } // namespace



  template <int dim>
  void
  Shape<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Shape",
                      shape,
                      "The body that the other parameters of this subsection describe.",
                      Patterns::Selection(shape_names<dim>("|")));
    prm.add_parameter("Invert", invert, "Take the outside of the body instead.");
    prm.add_parameter("Centre",
                      centre,
                      "sphere, cylinder, torus: the centre (m); half space: a point of "
                      "the plane (m).");
    prm.add_parameter("Radius",
                      radius,
                      "sphere, cylinder (2D: half the width), capsule, torus (of the "
                      "circle in its middle): the radius (m).");
    prm.add_parameter("Minor radius",
                      minor_radius,
                      "torus: the radius (m) of its tube, smaller than Radius; in 2D "
                      "half the width of the annulus.");
    prm.add_parameter("Axis", axis, "cylinder, torus: the direction of the axis.");
    prm.add_parameter("Length", length, "cylinder: the length (m) along the axis.");
    prm.add_parameter("Normal",
                      normal,
                      "half space: the direction normal to the plane, out of the body.");
    prm.add_parameter("Lower corner", lower_corner, "box: the smallest coordinates (m).");
    prm.add_parameter("Upper corner", upper_corner, "box: the largest coordinates (m).");
    prm.add_parameter("Start", start, "capsule: one end (m) of its middle line.");
    prm.add_parameter("End", end, "capsule: the other end (m) of its middle line.");
    prm.add_parameter("Expression",
                      expression,
                      "expression: a formula in x,y,z (2D: x,y) (m) that is near the "
                      "surface like a distance (m), negative inside.");
    prm.add_parameter("File",
                      file,
                      "triangle mesh: a closed surface, as OFF, OBJ, PLY or STL.",
                      Patterns::FileName());
    prm.add_parameter("Centre at origin",
                      centre_at_origin,
                      "triangle mesh: first move the centre of its bounding box to the "
                      "origin.");
    prm.add_parameter("Scale",
                      scale,
                      "triangle mesh: then multiply its coordinates by this (m per unit "
                      "of the file).");
    prm.add_parameter("Rotation axis",
                      rotation_axis,
                      "triangle mesh: then rotate it about this direction ...");
    prm.add_parameter("Rotation angle",
                      rotation_angle,
                      "triangle mesh: ... through the origin, by this angle (degrees, "
                      "right-handed).");
    prm.add_parameter("Translation",
                      translation,
                      "triangle mesh: last move it by this (m).");
  }



  template <int dim>
  Shape<dim>::Shape(const Parameters &parameters, const std::string &where)
    : sign(parameters.invert ? -1 : 1)
  {
    for (const auto &[name, make] : shapes<dim>())
      if (name == parameters.shape)
        distance = make(parameters, where);
    require(static_cast<bool>(distance),
            where + ": Shape is \"" + parameters.shape + "\", but must be one of " +
              shape_names<dim>(", ") + ".");
  }



  template class Shape<2>;
  template class Shape<3>;
} // namespace treacle
