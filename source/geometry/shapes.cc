// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/expression.h>
#include <treacle/geometry/pose.h>
#include <treacle/geometry/shapes.h>
#include <treacle/geometry/triangle_surface.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <tuple>

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
    using Parameters = ShapeParameters<dim>;


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
    std::pair<Distance<dim>, DistanceWithin<dim>>
    triangle_mesh(const Parameters<dim>           &p,
                  const std::string               &where,
                  [[maybe_unused]] const MPI_Comm &comm)
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
            std::make_shared<const TriangleSurface>(p.file, placement, where + "/File", comm);
          return {[surface](const Point<3> &x) { return surface->signed_distance(x); },
                  [surface](const Point<3> &x, const double reach) { return surface->distance_within(x, reach); }};
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

    /// A body where scale, rotation and translation put it.
    template <int dim>
    Distance<dim>
    placed(const Distance<dim> &body, const Parameters<dim> &p, const std::string &where)
    {
      require_positive(p.scale, where, "Scale");
      require(!p.centre_at_origin,
              where + ": Centre at origin is for the shape \"triangle mesh\"; the others say themselves where they are.");
      Tensor<1, dim == 2 ? 1 : 3> turn;
      if constexpr (dim == 2)
        turn[0] = 1;
      else
        turn = unit_vector(p.rotation_axis, where, "Rotation axis");
      if (p.scale == 1 && p.rotation_angle == 0 && p.translation.norm() == 0)
        return body;
      return [body, scale = p.scale, back = transpose(rotation_by(p.rotation_angle * numbers::PI / 180 * turn)), shift = p.translation](
               const Point<dim> &x) { return scale * body(Point<dim>(back * (x - shift) / scale)); };
    }

    template <int dim>
    Distance<dim>
    plain(const Parameters<dim> &p, const std::string &where)
    {
      switch (p.kind)
        {
          case ShapeKind::sphere:
            return sphere<dim>(p, where);
          case ShapeKind::box:
            return box<dim>(p, where);
          case ShapeKind::cylinder:
            return cylinder<dim>(p, where);
          case ShapeKind::capsule:
            return capsule<dim>(p, where);
          case ShapeKind::torus:
            return torus<dim>(p, where);
          case ShapeKind::half_space:
            return half_space<dim>(p, where);
          case ShapeKind::expression:
            return expression<dim>(p, where);
          case ShapeKind::triangle_mesh:
            break;
        }
      Assert(false, ExcInternalError());
      return {};
    }
  } // namespace

  template <int dim>
  Shape<dim>::Shape(const Parameters  &parameters,
                    const std::string &where,
                    const double       rounding,
                    const MPI_Comm    &comm)
    : sign(parameters.invert ? -1 : 1)
    , rounding(rounding)
  {
    if (parameters.kind == ShapeKind::triangle_mesh)
      std::tie(distance, within) = triangle_mesh<dim>(parameters, where, comm);
    else
      distance = placed<dim>(plain<dim>(parameters, where), parameters, where);
  }

  template class Shape<2>;
  template class Shape<3>;
} // namespace treacle
