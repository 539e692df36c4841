// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_velocity_integral_h
#define treacle_geometry_velocity_integral_h

#include <treacle/geometry/pose.h>

#include <functional>
#include <utility>
#include <vector>

namespace treacle
{
  /// Shift and rotation of a body since t = 0, from its velocities (m/s, 1/s). What it gives
  /// depends on the time alone, not on what was asked for before.
  template <int dim>
  class VelocityIntegral
  {
  public:
    using Displacement = std::pair<Tensor<1, dim>, Tensor<2, dim>>;
    using Velocity     = std::function<Tensor<1, dim>(const double)>;
    using Spin         = std::function<Tensor<1, Pose<dim>::n_rotations>(const double)>;

    /// The velocities, the same each time, are asked for from 0 to @p t.
    Displacement
    at(const double t, const Velocity &velocity, const Spin &spin);

  private:
    /// Where panels begin, at times that none asked for changes, and the displacements there.
    std::vector<double>       times{0.};
    std::vector<Displacement> displacements{{{}, unit_symmetric_tensor<dim>()}};
  };
} // namespace treacle

#endif
