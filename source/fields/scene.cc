// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/fields/scene.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace treacle
{
  namespace
  {
    std::string
    numbered(const std::string &name, const unsigned int k)
    {
      return name + " " + std::to_string(k + 1);
    }

    /// In the order of Scene::no_slip().
    template <int dim>
    std::vector<std::string>
    side_names()
    {
      if (dim == 2)
        return {"left", "right", "bottom", "top"};
      return {"left", "right", "front", "back", "bottom", "top"};
    }

    [[noreturn]] void
    wall_condition_error(const std::string &text,
                         const std::string &problem,
                         const int          dim)
    {
      throw UserError("Domain/Wall condition is \"" + text + "\", but " + problem +
                      "; write \"no slip\" or \"free slip\", or conditions per side as "
                      "in \"default: no slip; left, right: free slip\", with the sides "
                      "left, right, " +
                      (dim == 3 ? "front, back, " : "") + "bottom, top.");
    }

    /// Per side, then the default. Sides that are not mentioned, by name or as
    /// "default", are no slip.
    template <int dim>
    std::array<bool, 2 * dim + 1>
    parse_wall_condition(const std::string &text)
    {
      const std::vector<std::string> sides = side_names<dim>();
      std::map<std::string, bool>    no_slip;
      for (const std::string &clause : Utilities::split_string_list(text, ';'))
        {
          const std::size_t colon     = clause.find(':');
          const std::string condition = Utilities::trim(
            colon == std::string::npos ? clause : clause.substr(colon + 1));
          const std::string names =
            colon == std::string::npos ? "default" : clause.substr(0, colon);

          if (condition != "no slip" && condition != "free slip")
            wall_condition_error(text, "\"" + condition + "\" is no condition", dim);
          for (const std::string &name : Utilities::split_string_list(names, ','))
            {
              if (name != "default" && std::count(sides.begin(), sides.end(), name) == 0)
                wall_condition_error(text, "\"" + name + "\" is no side", dim);
              if (!no_slip.emplace(name, condition == "no slip").second)
                wall_condition_error(text, "it sets \"" + name + "\" twice", dim);
            }
        }
      if (no_slip.empty())
        wall_condition_error(text, "it sets no side", dim);

      no_slip.emplace("default", true);
      std::array<bool, 2 * dim + 1> result;
      result[2 * dim] = no_slip["default"];
      for (unsigned int side = 0; side < 2 * dim; ++side)
        result[side] = no_slip[no_slip.count(sides[side]) ? sides[side] : "default"];
      return result;
    }

    template <int dim>
    [[noreturn]] void
    value_error(const std::string &name,
                const double       value,
                const std::string &allowed,
                const Point<dim>  &x,
                const double       t)
    {
      std::ostringstream message;
      message << name << " is " << value << " at x = (" << x << ") and t = " << t
              << " s, but must be " << allowed << " in the liquid at all times.";
      throw UserError(message.str());
    }

    /// The entry with the smallest distance (there is at least one), and it.
    template <int dim>
    std::pair<unsigned int, double>
    nearest(const std::vector<Shape<dim>> &shapes, const Point<dim> &x)
    {
      std::pair<unsigned int, double> result(0, shapes[0].signed_distance(x));
      for (unsigned int k = 1; k < shapes.size(); ++k)
        {
          const double distance = shapes[k].signed_distance(x);
          if (distance < result.second)
            result = {k, distance};
        }
      return result;
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::Parameters::add_parameters(ParameterHandler  &prm,
                                         const unsigned int n_liquids,
                                         const unsigned int n_solids)
  {
    const std::string variables = (dim == 2 ? "x,y,t" : "x,y,z,t");
    const std::string vector =
      "; a formula in " + variables + " per component, separated by semicolons.";

    prm.enter_subsection("Domain");
    prm.add_parameter("Lower corner",
                      lower_corner,
                      "Smallest coordinates (m) of the box; a mesh from a file has its own.");
    prm.add_parameter("Upper corner",
                      upper_corner,
                      "Largest coordinates (m) of the box; a mesh from a file has its own.");
    prm.add_parameter("Wall condition",
                      wall_condition,
                      "\"no slip\" or \"free slip\", or per side, as in \"default: no "
                      "slip; left, right: free slip\": left and right along x, bottom "
                      "and top along the last axis, in 3D front and back along y. Walls of a "
                      "mesh from a file that are no side of its box have the default.");
    prm.leave_subsection();

    prm.enter_subsection("Material");
    prm.add_parameter("Density",
                      density,
                      "Density (kg/m^3; 2D: kg/m^2): a formula in " + variables +
                        ", positive in the liquid.");
    prm.add_parameter("Viscosity",
                      viscosity,
                      "Dynamic viscosity (Pa s): a formula in " + variables +
                        ", not negative in the liquid.");
    prm.add_parameter("Transport",
                      transport,
                      "\"fixed\": density and viscosity are what the formulas say at a "
                      "point and time.",
                      Patterns::Selection("fixed"));
    prm.leave_subsection();

    prm.enter_subsection("Gravity");
    prm.add_parameter("Acceleration",
                      acceleration,
                      "Body force per mass (m/s^2)" + vector);
    prm.leave_subsection();

    liquids.resize(n_liquids);
    for (unsigned int k = 0; k < n_liquids; ++k)
      {
        prm.enter_subsection(numbered("Liquid", k));
        liquids[k].shape.add_parameters(prm);
        prm.add_parameter("Velocity",
                          liquids[k].velocity,
                          "Velocity (m/s) at the start" + vector);
        prm.leave_subsection();
      }
    solids.resize(n_solids);
    for (unsigned int k = 0; k < n_solids; ++k)
      {
        prm.enter_subsection(numbered("Solid", k));
        solids[k].add_parameters(prm);
        prm.leave_subsection();
      }
  }



  template <int dim>
  Scene<dim>::Scene(const Parameters &parameters)
    : lower(parameters.lower_corner)
    , upper(parameters.upper_corner)
    , sticks(parse_wall_condition<dim>(parameters.wall_condition))
    , density_at(parameters.density, "Material/Density", true)
    , viscosity_at(parameters.viscosity, "Material/Viscosity", true)
    , gravity_at(parameters.acceleration, "Gravity/Acceleration")
  {
    for (unsigned int d = 0; d < dim; ++d)
      require(lower[d] < upper[d],
              "Domain/Upper corner must exceed Domain/Lower corner in every component.");
    if (density_at.is_constant())
      density(lower, 0.);
    if (viscosity_at.is_constant())
      viscosity(lower, 0.);

    require(!parameters.liquids.empty(),
            "There is no liquid: the subsection Liquid 1 must describe one.");
    for (unsigned int k = 0; k < parameters.liquids.size(); ++k)
      {
        const std::string where = numbered("Liquid", k);
        liquids.emplace_back(parameters.liquids[k].shape, where);
        liquid_velocities.emplace_back(parameters.liquids[k].velocity,
                                       where + "/Velocity");
      }
    for (unsigned int k = 0; k < parameters.solids.size(); ++k)
      solids.emplace_back(parameters.solids[k], numbered("Solid", k));
  }



  template <int dim>
  const Point<dim> &
  Scene<dim>::lower_corner() const
  {
    return lower;
  }

  template <int dim>
  const Point<dim> &
  Scene<dim>::upper_corner() const
  {
    return upper;
  }

  template <int dim>
  bool
  Scene<dim>::no_slip(const unsigned int wall) const
  {
    return sticks[std::min(wall, 2u * dim)];
  }

  template <int dim>
  unsigned int
  Scene<dim>::n_liquids() const
  {
    return liquids.size();
  }

  template <int dim>
  double
  Scene<dim>::liquid_distance(const unsigned int k, const Point<dim> &x) const
  {
    return liquids[k].signed_distance(x);
  }

  template <int dim>
  double
  Scene<dim>::liquid_distance(const Point<dim> &x) const
  {
    return nearest<dim>(liquids, x).second;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::initial_velocity(const Point<dim> &x) const
  {
    const unsigned int k = (liquids.size() == 1 ? 0 : nearest<dim>(liquids, x).first);
    const Tensor<1, dim> value = liquid_velocities[k](x, 0.);
    if (!std::isfinite(value.norm_square()))
      value_error(numbered("Liquid", k) + "/Velocity", value.norm(), "finite", x, 0.);
    return value;
  }

  template <int dim>
  bool
  Scene<dim>::has_solids() const
  {
    return !solids.empty();
  }

  template <int dim>
  double
  Scene<dim>::solid_distance(const Point<dim> &x, const double) const
  {
    return solids.empty() ? 1e30 : nearest<dim>(solids, x).second;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::solid_velocity(const Point<dim> &, const double) const
  {
    return Tensor<1, dim>();
  }



  template <int dim>
  double
  Scene<dim>::density(const Point<dim> &x, const double t) const
  {
    const double value = density_at(x, t);
    if (!(value > 0 && std::isfinite(value)))
      value_error("Material/Density", value, "positive", x, t);
    return value;
  }

  template <int dim>
  double
  Scene<dim>::viscosity(const Point<dim> &x, const double t) const
  {
    const double value = viscosity_at(x, t);
    if (!(value >= 0 && std::isfinite(value)))
      value_error("Material/Viscosity", value, "zero or positive", x, t);
    return value;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::gravity(const Point<dim> &x, const double t) const
  {
    const Tensor<1, dim> value = gravity_at(x, t);
    if (!std::isfinite(value.norm_square()))
      value_error("Gravity/Acceleration", value.norm(), "finite", x, t);
    return value;
  }



  template class Scene<2>;
  template class Scene<3>;
} // namespace treacle
