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

  /// Mean of v over the neighbours of an owned node where @p counts is positive, each
  /// as often as they share a cell. Returns whether there is one.
  template <int dim>
  bool
  mean_of_neighbours(const Mesh<dim>       &mesh,
                     const NodeVector<dim> &v,
                     const Vector          &counts,
                     const LocalIndex       node,
                     Tensor<1, dim>        &mean);

  /// Set the prescribed components at owned nodes and update the ghosts of v.
  template <int dim>
  void
  set_prescribed(const LiquidDomain<dim> &domain, NodeVector<dim> &v);

  /// H: node velocity from the liquid faces around a node by least squares,
  /// `(N^T N)^-1 N^T u` (the paper, section 4.3). Nodes where singular values below
  /// 0.1 of the largest would have to be cut are invalid: they receive the mean of
  /// their valid neighbours. Prescribed components are set. @p u must have up-to-date
  /// ghosts.
  template <int dim>
  void
  least_squares(const LiquidDomain<dim> &domain, const Vector &u, NodeVector<dim> &v);
} // namespace treacle

#endif
