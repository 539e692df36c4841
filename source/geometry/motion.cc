// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/motion.h>

#include <deal.II/physics/transformations.h>

#include <limits>

namespace treacle
{
  namespace
  {
    namespace Rotations = Physics::Transformations::Rotations;

    Tensor<2, 2>
    rotation_by(const Tensor<1, 1> &angle)
    {
      return Rotations::rotation_matrix_2d(angle[0]);
    }

    Tensor<2, 3>
    rotation_by(const Tensor<1, 3> &turn)
    {
      const double angle = turn.norm();
      return angle > 0 ? Rotations::rotation_matrix_3d(turn / angle, angle) :
                         Tensor<2, 3>(unit_symmetric_tensor<3>());
    }

    Tensor<2, 2>
    spin_of(const Tensor<1, 1> &w)
    {
      Tensor<2, 2> spin;
      spin[1][0] = w[0];
      spin[0][1] = -w[0];
      return spin;
    }

    Tensor<2, 3>
    spin_of(const Tensor<1, 3> &w)
    {
      Tensor<2, 3> spin;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const unsigned int i = (d + 1) % 3, j = (d + 2) % 3;
          spin[j][i]           = w[d];
          spin[i][j]           = -w[d];
        }
      return spin;
    }

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
    , last_time(std::numeric_limits<double>::quiet_NaN())
  {
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
    require(std::isfinite(value.norm_square()),
            where + (kind == Kind::velocity ? "/Velocity" : "/Displacement") +
              " is not finite at t = " + std::to_string(t) + " s.");
    return value;
  }

  template <int dim>
  Tensor<1, RigidMotion<dim>::n_rotations>
  RigidMotion<dim>::turn(const double t) const
  {
    Tensor<1, n_rotations> value;
    for (unsigned int d = 0; d < n_rotations; ++d)
      value[d] = turns[d](centre, t);
    require(std::isfinite(value.norm_square()),
            where + (kind == Kind::velocity ? "/Angular velocity" : "/Rotation") +
              " is not finite at t = " + std::to_string(t) + " s.");
    return value;
  }

  template <int dim>
  Pose<dim>
  RigidMotion<dim>::from_position(const double t) const
  {
    // central differences: second order, and far from rounding
    const double         delta = 1e-5 * std::max(1., std::abs(t));
    const Tensor<2, dim> r     = rotation_by(turn(t));
    const Tensor<2, dim> rate =
      (rotation_by(turn(t + delta)) - rotation_by(turn(t - delta))) / (2 * delta);
    const Tensor<2, dim> spin = rate * transpose(r);
    return {centre,
            translation(t),
            r,
            (translation(t + delta) - translation(t - delta)) / (2 * delta),
            0.5 * (spin - transpose(spin))};
  }

  template <int dim>
  Pose<dim>
  RigidMotion<dim>::from_velocity(const double t) const
  {
    // Gauss's two points in each of n panels; the rotation by Magnus' series, whose
    // second term vanishes for a fixed axis: both of fourth order
    constexpr unsigned int n    = 1000;
    const double           step = t / n, offset = 0.5 / std::sqrt(3.);
    Pose<dim>              pose{centre, {}, {}, translation(t), spin_of(turn(t))};
    for (unsigned int d = 0; d < dim; ++d)
      pose.rotation[d][d] = 1;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double t1 = (k + 0.5 - offset) * step, t2 = (k + 0.5 + offset) * step;
        pose.shift += 0.5 * step * (translation(t1) + translation(t2));
        const Tensor<1, n_rotations> w1 = turn(t1), w2 = turn(t2);
        Tensor<1, n_rotations>       angle = 0.5 * step * (w1 + w2);
        if constexpr (dim == 3)
          angle += std::sqrt(3.) / 12 * step * step * cross_product_3d(w2, w1);
        pose.rotation = rotation_by(angle) * pose.rotation;
      }
    return pose;
  }

  template <int dim>
  const Pose<dim> &
  RigidMotion<dim>::at(const double t) const
  {
    if (t != last_time)
      {
        last      = kind == Kind::velocity ? from_velocity(t) : from_position(t);
        last_time = t;
      }
    return last;
  }

  template class RigidMotion<2>;
  template class RigidMotion<3>;
} // namespace treacle
