// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exceptions.h>
#include <treacle/scene/bodies.h>
#include <treacle/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace treacle
{
  namespace
  {
    /// How to write a vector.
    template <int dim>
    std::string
    formulas()
    {
      return std::string("; a formula in ") + (dim == 2 ? "x,y,t" : "x,y,z,t") +
             " per component, separated by semicolons.";
    }

    template <int dim>
    BoundingBox<dim>
    checked_box(const Point<dim> &lower, const Point<dim> &upper)
    {
      for (unsigned int d = 0; d < dim; ++d)
        require(
          lower[d] < upper[d],
          "Domain/Upper corner must exceed Domain/Lower corner in every component.");
      return BoundingBox<dim>({lower, upper});
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::Parameters::Liquid::add_parameters(ParameterHandler &prm)
  {
    shape.add_parameters(prm);
    prm.add_parameter("Velocity",
                      velocity,
                      "Velocity (m/s) at the start" + formulas<dim>() + " Where liquids overlap the highest number counts, for materials too.");
    material.add_parameters(prm, "; as in Material if empty (Transport = advected).");
  }

  template <int dim>
  void
  Scene<dim>::Parameters::add_domain(ParameterHandler &prm)
  {
    prm.enter_subsection("Domain");
    prm.add_parameter(
      "Lower corner",
      lower_corner,
      "Smallest coordinates (m) of the box; a mesh from a file has its own.");
    prm.add_parameter(
      "Upper corner",
      upper_corner,
      "Largest coordinates (m) of the box; a mesh from a file has its own.");
    prm.add_parameter(
      "Wall condition",
      wall_condition,
      "\"no slip\" or \"free slip\", or per side, as in \"default: no "
      "slip; left, right: free slip\": left and right along x, bottom "
      "and top along the last axis, in 3D front and back along y. Walls of a "
      "mesh from a file that are no side of its box have the default.");
    prm.add_parameter("Wall level",
                      wall_level,
                      "Smallest level of the leaves of liquid along sides of the box where it does "
                      "not slip; at most Mesh/Surface level.",
                      Patterns::Integer(0, 18));
    prm.leave_subsection();
  }

  template <int dim>
  void
  Scene<dim>::Parameters::add_material_and_gravity(ParameterHandler &prm)
  {
    prm.enter_subsection("Material");
    material.add_parameters(prm, ".");
    add_choice(
      prm,
      "Transport",
      transport,
      "\"fixed\": density and viscosity are what the formulas say at a point and "
      "time. \"advected\": they are carried with the liquid, from their values at "
      "t = 0 or where an emitter pours it out.",
      {{"fixed", MaterialTransport::fixed}, {"advected", MaterialTransport::advected}});
    prm.leave_subsection();

    prm.enter_subsection("Gravity");
    prm.add_parameter("Acceleration",
                      acceleration,
                      "Body force per mass (m/s^2)" + formulas<dim>());
    prm.leave_subsection();
  }

  template <int dim>
  void
  Scene<dim>::Parameters::add_parameters(ParameterHandler  &prm,
                                         const unsigned int n_liquids,
                                         const unsigned int n_solids,
                                         const unsigned int n_emitters)
  {
    add_domain(prm);
    add_material_and_gravity(prm);
    add_numbered(prm, "Liquid", liquids, n_liquids);
    add_numbered(prm, "Solid", solids, n_solids);
    add_numbered(prm, "Emitter", emitters, n_emitters);
  }



  template <int dim>
  Scene<dim>::Scene(const Parameters &parameters, const MPI_Comm &comm)
    : Solids<dim>(parameters.solids,
                  checked_box(parameters.lower_corner, parameters.upper_corner),
                  comm)
    , Emitters<dim>(parameters.emitters,
                    Material<dim>(parameters.material, "Material"),
                    checked_box(parameters.lower_corner, parameters.upper_corner),
                    comm)
    , lower(parameters.lower_corner)
    , upper(parameters.upper_corner)
    , least_distance(rounding_in<dim>({{lower, upper}}))
    , walls(parse_wall_condition<dim>(parameters.wall_condition))
    , wall_level(parameters.wall_level)
    , material(parameters.material, "Material")
    , transport(parameters.transport)
    , gravity_at(parameters.acceleration, "Gravity/Acceleration")
  {
    require(!parameters.liquids.empty() || !parameters.emitters.empty(),
            "There is no liquid: a subsection Liquid 1 or Emitter 1 must describe one.");
    check_transport(parameters);
    for (unsigned int k = 0; k < parameters.liquids.size(); ++k)
      {
        const auto       &liquid = parameters.liquids[k];
        const std::string where  = numbered("Liquid", k);
        liquids.push_back({Shape<dim>(liquid.shape, where, least_distance, comm),
                           VectorExpression<dim>(liquid.velocity, where + "/Velocity"),
                           Material<dim>(liquid.material, where, &material)});
      }
  }

  template <int dim>
  void
  Scene<dim>::check_transport(const Parameters &parameters) const
  {
    const auto check = [&](const auto &list, const std::string &name) {
      for (unsigned int k = 0; k < list.size(); ++k)
        require(has_advected_material() || list[k].material.is_empty(),
                numbered(name, k) +
                  " has a material of its own, which must travel with it: set "
                  "Material/Transport = advected.");
    };
    check(parameters.liquids, "Liquid");
    check(parameters.emitters, "Emitter");
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
    return walls[std::min(wall, 2u * dim)] == WallCondition::no_slip;
  }

  template <int dim>
  unsigned int
  Scene<dim>::level_near(const Point<dim> &x, const double distance, const double t) const
  {
    const unsigned int level = this->level_near_solids(x, distance, t);
    for (unsigned int side = 0; side < 2 * dim && wall_level > level; ++side)
      if (const unsigned int d = side / 2;
          no_slip(side) && (side % 2 == 0 ? x[d] - lower[d] : upper[d] - x[d]) < distance)
        return wall_level;
    return level;
  }

  template <int dim>
  bool
  Scene<dim>::asks_for_levels() const
  {
    return wall_level > 0 || this->solids_ask_for_levels();
  }

  template <int dim>
  double
  Scene<dim>::side_of_liquid(const unsigned int k, const Point<dim> &x) const
  {
    const double least = liquids[k].shape.least_distance(x);
    return least > 0 ? least : liquids[k].shape.signed_distance(x);
  }

  template <int dim>
  double
  Scene<dim>::liquid_distance(const Point<dim> &x) const
  {
    return std::min(distance_to_liquids(x), this->emitter_distance(x, 0.));
  }

  template <int dim>
  double
  Scene<dim>::distance_to_liquids(const Point<dim> &x) const
  {
    return liquids.empty() ? std::numeric_limits<double>::max() : nearest_liquid(x).second;
  }

  template <int dim>
  std::pair<const typename Scene<dim>::Liquid *, double>
  Scene<dim>::nearest_liquid(const Point<dim> &x) const
  {
    return nearest(
      liquids,
      // far off where a formula is no number
      [&](const Liquid &liquid) { return std::fmin(liquid.shape.signed_distance(x), std::numeric_limits<double>::max()); },
      [&](const Liquid &liquid) { return liquid.shape.least_distance(x); });
  }

  template <int dim>
  const typename Scene<dim>::Liquid &
  Scene<dim>::liquid_at(const Point<dim> &x) const
  {
    for (unsigned int k = liquids.size() - 1; k > 0; --k)
      if (side_of_liquid(k, x) < 0)
        return liquids[k];
    return liquids.size() == 1 ? liquids.front() : *nearest_liquid(x).first;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::initial_velocity(const Point<dim> &x) const
  {
    const auto [emitter, distance] = this->nearest_emitter(x, 0.);
    if (distance < 0 || liquids.empty())
      return emitter ? emitter->velocity(x, 0.) : Tensor<1, dim>();
    const Liquid        &liquid = liquid_at(x);
    const Tensor<1, dim> value  = liquid.velocity(x, 0.);
    if (!std::isfinite(value.norm_square()))
      value_error(numbered("Liquid", &liquid - liquids.data()) + "/Velocity",
                  value.norm(),
                  "finite",
                  x,
                  0.);
    return value;
  }

  template <int dim>
  const Material<dim> &
  Scene<dim>::initial_material(const Point<dim> &x) const
  {
    const auto [emitter, distance] = this->nearest_emitter(x, 0.);
    if (distance < 0 || liquids.empty())
      return emitter ? emitter->material : material;
    return liquid_at(x).material;
  }

  template <int dim>
  bool
  Scene<dim>::is_emitter_nearest(const Point<dim> &x, const double t) const
  {
    const double distance = this->emitter_distance(x, t);
    return distance < far_away && distance < this->solid_distance(x, t);
  }

  template <int dim>
  bool
  Scene<dim>::has_advected_material() const
  {
    return transport == MaterialTransport::advected;
  }

  template <int dim>
  double
  Scene<dim>::density(const Point<dim> &x, const double t) const
  {
    return material.density(x, t);
  }

  template <int dim>
  double
  Scene<dim>::viscosity(const Point<dim> &x, const double t) const
  {
    return material.viscosity(x, t);
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
