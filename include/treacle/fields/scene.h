// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_scene_h
#define treacle_fields_scene_h

#include <treacle/geometry/expression.h>
#include <treacle/geometry/shapes.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// What the parameter file says of the world: box, walls, liquids, solids,
  /// material, gravity. Positions in m, time in s, no state of its own.
  template <int dim>
  class Scene
  {
  public:
    struct Parameters
    {
      using ShapeParameters = typename Shape<dim>::Parameters;

      struct Liquid
      {
        ShapeParameters shape;
        std::string     velocity = (dim == 2 ? "0; 0" : "0; 0; 0"); // m/s
      };

      Point<dim>  lower_corner;
      Point<dim>  upper_corner   = diagonal_point<dim>(1);
      std::string wall_condition = "no slip";
      std::string density        = "1000"; // kg/m^dim
      std::string viscosity      = "150";  // Pa s
      std::string transport      = "fixed";
      std::string acceleration   = (dim == 2 ? "0; -9.81" : "0; 0; -9.81"); // m/s^2

      std::vector<Liquid>          liquids;
      std::vector<ShapeParameters> solids;

      /// Declare the subsections, with Liquid 1 to n_liquids and Solid 1 to
      /// n_solids; @p prm writes into this object when it parses.
      void
      add_parameters(ParameterHandler  &prm,
                     const unsigned int n_liquids,
                     const unsigned int n_solids);
    };

    /// Throws a UserError that names the parameter at fault.
    explicit Scene(const Parameters &parameters);

    const Point<dim> &
    lower_corner() const;
    const Point<dim> &
    upper_corner() const;

    /// Does the liquid stick to this kind of wall? Sides of the box are 2 axis +
    /// (upper ? 1 : 0); all others, see Walls, have the default condition.
    bool
    no_slip(const unsigned int wall) const;

    unsigned int n_liquids() const;

    /// Signed distance to liquid k (from 0) at t = 0, negative inside.
    double liquid_distance(const unsigned int k, const Point<dim> &x) const;

    /// Signed distance to the union of the liquids at t = 0, negative inside.
    double
    liquid_distance(const Point<dim> &x) const;

    /// Velocity at t = 0: that of the liquid whose distance is smallest.
    Tensor<1, dim>
    initial_velocity(const Point<dim> &x) const;

    bool
    has_solids() const;

    /// Signed distance to the union of the solids, positive outside
    /// them (where liquid may be); a large number if there is none.
    double
    solid_distance(const Point<dim> &x, const double t) const;

    Tensor<1, dim>
    solid_velocity(const Point<dim> &x, const double t) const;

    double
    density(const Point<dim> &x, const double t) const; // kg/m^dim
    double
    viscosity(const Point<dim> &x, const double t) const; // Pa s
    Tensor<1, dim>
    gravity(const Point<dim> &x, const double t) const; // m/s^2

  private:
    Point<dim>                         lower, upper;
    std::array<bool, 2 * dim + 1>      sticks; // per side of the box; the default
    std::vector<Shape<dim>>            liquids;
    std::vector<VectorExpression<dim>> liquid_velocities;
    std::vector<Shape<dim>>            solids;
    Expression<dim>                    density_at, viscosity_at;
    VectorExpression<dim>              gravity_at;
  };
} // namespace treacle

#endif
