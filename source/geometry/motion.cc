// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/motion.h>

#include <algorithm>
#include <limits>

namespace treacle
{
  namespace
  {
    bool
    is_zero(const std::string &formulas)
    {
      return formulas.find_first_not_of("0; .") == std::string::npos;
    }

    template <int dim>
    std::vector<Expression<dim>>
    parse(const std::string &formulas, const unsigned int n, const std::string &where)
    {
      const auto parts = Utilities::split_string_list(formulas, ';');
      require(parts.size() == n,
              where + " is \"" + formulas + "\", but needs " + std::to_string(n) +
                " formula(s) in t" + (n > 1 ? ", separated by semicolons." : "."));
      std::vector<Expression<dim>> result;
      for (const std::string &part : parts)
        result.emplace_back(part, where, true);
      return result;
    }
  } // namespace

  template <int dim>
  void
  RigidMotion<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    const std::string per_component = "formulas in t, separated by semicolons.";
    const std::string turns =
      dim == 2 ? "a formula in t." : "a vector along the axis, its length the angle; " + per_component;
    prm.add_parameter("Centre of rotation", centre, "At t = 0 (m); it moves with the solid.");
    prm.add_parameter("Displacement",
                      displacement,
                      "Of the solid from where its shape puts it (m); " + per_component);
    prm.add_parameter("Rotation", rotation, "Of the solid from its shape (rad): " + turns);
    prm.add_parameter("Velocity",
                      velocity,
                      "Of the centre of rotation (m/s), instead of Displacement and Rotation; " +
                        per_component);
    prm.add_parameter("Angular velocity",
                      angular_velocity,
                      "Instead of Displacement and Rotation (rad/s): " + turns);
  }

  template <int dim>
  RigidMotion<dim>::RigidMotion(const Parameters &prm, const std::string &where)
    : where(where)
    , centre(prm.centre)
  {
    known.fill({std::numeric_limits<double>::quiet_NaN(), {}});
    const bool by_position = !is_zero(prm.displacement) || !is_zero(prm.rotation);
    const bool by_velocity = !is_zero(prm.velocity) || !is_zero(prm.angular_velocity);
    require(!by_position || !by_velocity,
            where + " has two motions: give Displacement and Rotation, or Velocity and Angular "
                    "velocity.");
    kind = by_position ? Kind::position : by_velocity ? Kind::velocity : Kind::at_rest;
    // understood even where they are zero, so that mistakes show
    const auto displacement = parse<dim>(prm.displacement, dim, where + "/Displacement");
    const auto rotation     = parse<dim>(prm.rotation, n_rotations, where + "/Rotation");
    const auto velocity     = parse<dim>(prm.velocity, dim, where + "/Velocity");
    const auto angular =
      parse<dim>(prm.angular_velocity, n_rotations, where + "/Angular velocity");
    translations = by_velocity ? velocity : displacement;
    turns        = by_velocity ? angular : rotation;
    at(0);
  }

  template <int dim>
  Tensor<1, dim>
  RigidMotion<dim>::translation(const double t) const
  {
    Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = translations[d](centre, t);
    if (!std::isfinite(value.norm_square()))
      throw_not_finite(kind == Kind::velocity ? "/Velocity" : "/Displacement", t);
    return value;
  }

  template <int dim>
  Tensor<1, RigidMotion<dim>::n_rotations>
  RigidMotion<dim>::turn(const double t) const
  {
    Tensor<1, n_rotations> value;
    for (unsigned int d = 0; d < n_rotations; ++d)
      value[d] = turns[d](centre, t);
    if (!std::isfinite(value.norm_square()))
      throw_not_finite(kind == Kind::velocity ? "/Angular velocity" : "/Rotation", t);
    return value;
  }

  template <int dim>
  void
  RigidMotion<dim>::throw_not_finite(const std::string &formulas, const double t) const
  {
    throw UserError(where + formulas + " is not finite at t = " + std::to_string(t) + " s.");
  }

  namespace
  {
    /// df/dt of second order and far from rounding: by central differences, but where they
    /// would ask for a time before 0.
    template <typename Function>
    auto
    derivative(const Function &f, const double t)
    {
      const double delta = 1e-5 * std::max(1., 1e-3 * t);
      const double later = t + delta, earlier = t - delta;
      if (earlier >= 0)
        return (f(later) - f(earlier)) / (later - earlier);
      return (4. * f(later) - 3. * f(t) - f(t + 2 * delta)) / (2 * delta);
    }
  } // namespace

  template <int dim>
  Pose<dim>
  RigidMotion<dim>::from_position(const double t) const
  {
    const auto rotation_at    = [&](const double time) { return rotation_by(turn(time)); };
    const auto translation_at = [&](const double time) { return translation(time); };

    const Tensor<2, dim> r    = rotation_at(t);
    const Tensor<2, dim> spin = derivative(rotation_at, t) * transpose(r);
    return {centre,
            translation(t),
            r,
            derivative(translation_at, t),
            0.5 * (spin - transpose(spin))};
  }

  template <int dim>
  Pose<dim>
  RigidMotion<dim>::from_velocity(const double t) const
  {
    Pose<dim> pose{centre, {}, {}, translation(t), spin_of(turn(t))};
    std::tie(pose.shift, pose.rotation) =
      integral.at(t,
                  [&](const double time) { return translation(time); },
                  [&](const double time) { return turn(time); });
    return pose;
  }

  template <int dim>
  const Pose<dim> &
  RigidMotion<dim>::at(const double t) const
  {
    for (const auto &[time, pose] : known)
      if (time == t)
        return pose;
    auto &oldest    = known[next_to_forget];
    next_to_forget = (next_to_forget + 1) % known.size();
    oldest         = {t, kind == Kind::velocity ? from_velocity(t) : from_position(t)};
    return oldest.second;
  }

  template class RigidMotion<2>;
  template class RigidMotion<3>;
} // namespace treacle
