// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_pose_h
#define treacle_geometry_pose_h

#include <treacle/base/types.h>

namespace treacle
{
  /// Where a rigid body is at one time, and how it moves.
  template <int dim>
  struct Pose
  {
    static constexpr int n_rotations = dim == 2 ? 1 : 3;

    Point<dim>     start;    ///< the centre of rotation at t = 0 (m)
    Tensor<1, dim> shift;    ///< of that centre since then (m)
    Tensor<2, dim> rotation; ///< since t = 0
    Tensor<1, dim> velocity; ///< of the centre (m/s)
    Tensor<2, dim> spin;     ///< antisymmetric: spin * r is angular velocity x r (1/s)

    /// Where the material point that is at @p x now was at t = 0.
    Point<dim>
    at_start(const Point<dim> &x) const
    {
      return start + transpose(rotation) * (x - shift - start);
    }

    /// Where the material point is now that was at @p x at t = 0.
    Point<dim>
    now(const Point<dim> &x) const
    {
      return start + shift + rotation * (x - start);
    }

    Tensor<1, dim>
    velocity_at(const Point<dim> &x) const
    {
      return velocity + spin * (x - shift - start);
    }
  };

  /// By an angle, or (3D) about a vector by its length (rad).
  Tensor<2, 2>
  rotation_by(const Tensor<1, 1> &angle);
  Tensor<2, 3>
  rotation_by(const Tensor<1, 3> &turn);

  /// The antisymmetric tensor of an angular velocity.
  Tensor<2, 2>
  spin_of(const Tensor<1, 1> &w);
  Tensor<2, 3>
  spin_of(const Tensor<1, 3> &w);
} // namespace treacle

#endif
