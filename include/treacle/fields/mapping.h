// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_mapping_h
#define treacle_fields_mapping_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// P: face velocity from node velocity, n·(mean over the face's nodes); exact
  /// for linear fields at the barycentre.
  template <int dim>
  double
  face_velocity(const Mesh<dim> &mesh, const NodeVector<dim> &v, const LocalIndex face);

  /// H: node velocity from the liquid faces around a node by least squares,
  /// `(N^T N)^-1 N^T u` (the paper, section 4.3). Nodes where singular
  /// values below 0.1 of the largest had to be cut keep that part zero and count
  /// as invalid; prescribed components are set. Returns which nodes
  /// are valid, ghosts included. @p u must have up-to-date ghosts.
  template <int dim>
  std::vector<unsigned char>
  least_squares(const LiquidDomain<dim> &domain, const Vector &u, NodeVector<dim> &v);
} // namespace treacle

#endif
