// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_face_node_h
#define treacle_fields_face_node_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Mean over the face's nodes: at its barycentre (m/s).
  template <int dim>
  Tensor<1, dim>
  mean_at_face(const Mesh<dim> &mesh, const NodeVector<dim> &v, const LocalIndex face)
  {
    Tensor<1, dim> mean;
    for (const LocalIndex node : mesh.face_nodes[face])
      mean += v.value(node) / dim;
    return mean;
  }

  /// P: face velocity from node velocity, n·(mean over the face's nodes); exact
  /// for linear fields at the barycentre.
  template <int dim>
  double
  face_velocity(const Mesh<dim> &mesh, const NodeVector<dim> &v, const LocalIndex face);

  /// Set the prescribed components at a node.
  template <int dim>
  void
  set_prescribed(const LiquidDomain<dim> &domain, const LocalIndex node, NodeVector<dim> &v);

  /// Set the prescribed components at owned nodes and update the ghosts of v.
  template <int dim>
  void
  set_prescribed(const LiquidDomain<dim> &domain, NodeVector<dim> &v);

  /// Node velocity in two steps (Klingner et al. 2006): that of each active cell
  /// by least squares from all its faces, walls and solids included, then the
  /// mean over the cells around a node, weighted by their volume. Prescribed components are
  /// set. @p u must have up-to-date ghosts.
  template <int dim>
  void
  two_step(const LiquidDomain<dim> &domain, const Vector &u, NodeVector<dim> &v);
} // namespace treacle

#endif
