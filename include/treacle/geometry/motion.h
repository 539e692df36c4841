// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_motion_h
#define treacle_geometry_motion_h

#include <treacle/geometry/expression.h>
#include <treacle/geometry/velocity_integral.h>

#include <deal.II/base/parameter_handler.h>

#include <array>

namespace treacle
{
  /// The motion of a solid: its position and rotation as formulas, or its velocities,
  /// which are integrated from t = 0. A function of time alone, so that a
  /// resumed run finds the solid at the same place. Formulas are asked for at t >= 0 only.
  template <int dim>
  class RigidMotion
  {
  public:
    struct Parameters
    {
      static constexpr const char *no_vector = dim == 2 ? "0; 0" : "0; 0; 0";
      static constexpr const char *no_spin   = dim == 2 ? "0" : "0; 0; 0";

      Point<dim>  centre;
      std::string displacement     = no_vector; // m
      std::string rotation         = no_spin;   // rad
      std::string velocity         = no_vector; // m/s
      std::string angular_velocity = no_spin;   // rad/s

      /// Declare in the current subsection.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// @p where names the subsection in messages. Throws a UserError where a
    /// formula cannot be understood, or both kinds of motion are given.
    RigidMotion(const Parameters &parameters, const std::string &where);

    bool
    is_moving() const
    {
      return kind != Kind::at_rest;
    }

    /// Throws a UserError where a formula is not finite. Good until other times are asked for.
    const Pose<dim> &
    at(const double t) const;

  private:
    enum class Kind
    {
      at_rest,
      position,
      velocity
    };

    static constexpr int n_rotations = Pose<dim>::n_rotations;

    /// The value of formulas at t. Throws a UserError where it is not finite.
    Tensor<1, dim>
    translation(const double t) const;

    Tensor<1, n_rotations>
    turn(const double t) const;

    [[noreturn]] void
    throw_not_finite(const std::string &formulas, const double t) const;

    Pose<dim>
    from_position(const double t) const;

    Pose<dim>
    from_velocity(const double t) const;

    Kind                         kind = Kind::at_rest;
    std::string                  where;
    Point<dim>                   centre;
    std::vector<Expression<dim>> translations, turns;
    /// The last poses found, with their times: a step goes back and forth between its
    /// beginning and its end.
    mutable std::array<std::pair<double, Pose<dim>>, 4> known;
    mutable unsigned int                                next_to_forget = 0;
    mutable VelocityIntegral<dim> integral; ///< of the motion by velocities
  };
} // namespace treacle

#endif
