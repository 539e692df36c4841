// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/scene/scene.h>
#include <treacle/scene/wall_condition.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

    /// The entry with the smallest distance (there is at least one), and it.
    template <typename Body, typename Distance>
    std::pair<const Body *, double>
    nearest(const std::vector<Body> &bodies, const Distance &distance_of)
    {
      std::pair<const Body *, double> result(nullptr, std::numeric_limits<double>::infinity());
      for (const Body &body : bodies)
        if (const double distance = distance_of(body); result.first == nullptr || distance < result.second)
          result = {&body, distance};
      return result;
    }

    /// What stands for a distance from nothing (m): finite, for it is interpolated.
    constexpr double far_away = 1e30;
  } // namespace



  template <int dim>
  void
  Scene<dim>::Parameters::add_parameters(ParameterHandler  &prm,
                                         const unsigned int n_liquids,
                                         const unsigned int n_solids,
                                         const unsigned int n_emitters)
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
    material.add_parameters(prm, ".");
    prm.add_parameter("Transport",
                      transport,
                      "\"fixed\": density and viscosity are what the formulas say at a point and "
                      "time. \"advected\": they are carried with the liquid, from their values at "
                      "t = 0 or where an emitter pours it out.",
                      Patterns::Selection("fixed|advected"));
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
        liquids[k].material.add_parameters(prm,
                                           "; as in Material if empty (Transport = advected).");
        prm.leave_subsection();
      }
    solids.resize(n_solids);
    for (unsigned int k = 0; k < n_solids; ++k)
      {
        prm.enter_subsection(numbered("Solid", k));
        solids[k].add_parameters(prm);
        prm.leave_subsection();
      }
    emitters.resize(n_emitters);
    for (unsigned int k = 0; k < n_emitters; ++k)
      {
        prm.enter_subsection(numbered("Emitter", k));
        emitters[k].add_parameters(prm);
        prm.leave_subsection();
      }
  }



  template <int dim>
  Scene<dim>::Scene(const Parameters &parameters, const MPI_Comm &comm)
    : lower(parameters.lower_corner)
    , upper(parameters.upper_corner)
    , sticks(parse_wall_condition<dim>(parameters.wall_condition))
    , material(parameters.material, "Material")
    , advected_material(parameters.transport == "advected")
    , gravity_at(parameters.acceleration, "Gravity/Acceleration")
  {
    for (unsigned int d = 0; d < dim; ++d)
      require(lower[d] < upper[d],
              "Domain/Upper corner must exceed Domain/Lower corner in every component.");
    require(!parameters.liquids.empty() || !parameters.emitters.empty(),
            "There is no liquid: a subsection Liquid 1 or Emitter 1 must describe one.");
    check_transport(parameters);
    for (unsigned int k = 0; k < parameters.liquids.size(); ++k)
      {
        const auto       &liquid = parameters.liquids[k];
        const std::string where  = numbered("Liquid", k);
        liquids.push_back({Shape<dim>(liquid.shape, where, comm),
                           VectorExpression<dim>(liquid.velocity, where + "/Velocity"),
                           Material<dim>(liquid.material, where, &material)});
      }
    for (unsigned int k = 0; k < parameters.solids.size(); ++k)
      solids.emplace_back(parameters.solids[k],
                          numbered("Solid", k),
                          BoundingBox<dim>({lower, upper}),
                          comm);
    for (unsigned int k = 0; k < parameters.emitters.size(); ++k)
      emitter_list.emplace_back(parameters.emitters[k], numbered("Emitter", k), material, comm);
  }

  template <int dim>
  void
  Scene<dim>::check_transport(const Parameters &parameters) const
  {
    const auto check = [&](const auto &list, const std::string &name) {
      for (unsigned int k = 0; k < list.size(); ++k)
        require(advected_material || list[k].material.is_empty(),
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
    return liquids[k].shape.signed_distance(x);
  }

  template <int dim>
  double
  Scene<dim>::liquid_distance(const Point<dim> &x) const
  {
    double distance = emitter_distance(x, 0.);
    for (const Liquid &liquid : liquids)
      distance = std::min(distance, liquid.shape.signed_distance(x));
    return distance;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::initial_velocity(const Point<dim> &x) const
  {
    const auto [emitter, distance] = nearest_emitter(x, 0.);
    if (distance < 0 || liquids.empty())
      return emitter ? emitter->velocity(x, 0.) : Tensor<1, dim>();
    const Liquid *liquid =
      nearest(liquids, [&](const Liquid &l) { return l.shape.signed_distance(x); }).first;
    const Tensor<1, dim> value = liquid->velocity(x, 0.);
    if (!std::isfinite(value.norm_square()))
      value_error(numbered("Liquid", liquid - liquids.data()) + "/Velocity", value.norm(), "finite", x, 0.);
    return value;
  }

  template <int dim>
  const Material<dim> &
  Scene<dim>::initial_material(const Point<dim> &x) const
  {
    const auto [emitter, distance] = nearest_emitter(x, 0.);
    if (distance < 0 || liquids.empty())
      return emitter ? emitter->material : material;
    return nearest(liquids, [&](const Liquid &l) { return l.shape.signed_distance(x); })
      .first->material;
  }

  template <int dim>
  bool
  Scene<dim>::has_solids() const
  {
    return !solids.empty();
  }

  template <int dim>
  double
  Scene<dim>::solid_distance(const Point<dim> &x, const double t) const
  {
    const auto distance = [&](const Solid<dim> &solid) { return solid.signed_distance(x, t); };
    return solids.empty() ? far_away : nearest(solids, distance).second;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::solid_velocity(const Point<dim> &x, const double t) const
  {
    const auto distance = [&](const Solid<dim> &solid) { return solid.signed_distance(x, t); };
    return solids.empty() ? Tensor<1, dim>() : nearest(solids, distance).first->velocity(x, t);
  }

  template <int dim>
  unsigned int
  Scene<dim>::n_solids() const
  {
    return solids.size();
  }

  template <int dim>
  unsigned int
  Scene<dim>::nearest_solid(const Point<dim> &x, const double t) const
  {
    const auto distance = [&](const Solid<dim> &solid) { return solid.signed_distance(x, t); };
    return nearest(solids, distance).first - solids.data();
  }

  template <int dim>
  Point<dim>
  Scene<dim>::solid_centre(const unsigned int k, const double t) const
  {
    return solids[k].centre(t);
  }

  template <int dim>
  void
  Scene<dim>::check_solids(const double t) const
  {
    for (const Solid<dim> &solid : solids)
      solid.check(t);
  }



  template <int dim>
  const std::vector<Emitter<dim>> &
  Scene<dim>::emitters() const
  {
    return emitter_list;
  }

  template <int dim>
  std::pair<const Emitter<dim> *, double>
  Scene<dim>::nearest_emitter(const Point<dim> &x, const double t) const
  {
    std::pair<const Emitter<dim> *, double> result(nullptr, far_away);
    for (const Emitter<dim> &emitter : emitter_list)
      if (emitter.is_at_work(t))
        if (const double distance = emitter.signed_distance(x); distance < result.second)
          result = {&emitter, distance};
    return result;
  }

  template <int dim>
  double
  Scene<dim>::emitter_distance(const Point<dim> &x, const double t) const
  {
    return nearest_emitter(x, t).second;
  }

  template <int dim>
  Tensor<1, dim>
  Scene<dim>::emitter_velocity(const Point<dim> &x, const double t) const
  {
    const Emitter<dim> *emitter = nearest_emitter(x, t).first;
    return emitter ? emitter->velocity(x, t) : Tensor<1, dim>();
  }

  template <int dim>
  double
  Scene<dim>::distance_to_emitter_boundary(const Point<dim> &x, const double t) const
  {
    double smallest = far_away;
    for (const Emitter<dim> &emitter : emitter_list)
      if (t < emitter.stop_time)
        smallest = std::min(smallest, std::abs(emitter.signed_distance(x)));
    return smallest;
  }

  template <int dim>
  double
  Scene<dim>::next_switch(const double t) const
  {
    double next = std::numeric_limits<double>::infinity();
    for (const Emitter<dim> &emitter : emitter_list)
      for (const double time : {emitter.start_time, emitter.stop_time})
        if (time > t * (1 + 1e-12))
          next = std::min(next, time);
    return next;
  }

  template <int dim>
  bool
  Scene<dim>::has_switch_at(const double t) const
  {
    return std::any_of(emitter_list.begin(), emitter_list.end(), [&](const Emitter<dim> &emitter) {
      return std::abs(emitter.start_time - t) <= 1e-12 * t || std::abs(emitter.stop_time - t) <= 1e-12 * t;
    });
  }



  template <int dim>
  bool
  Scene<dim>::has_advected_material() const
  {
    return advected_material;
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
