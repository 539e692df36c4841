// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/pose.h>

#include <deal.II/physics/transformations.h>

namespace treacle
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
} // namespace treacle
