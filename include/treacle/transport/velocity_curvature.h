// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_velocity_curvature_h
#define treacle_transport_velocity_curvature_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/mesh/tracer.h>

namespace treacle
{
  /// 1 at nodes between which a velocity bends: all of their cells are full of liquid, of which viscosity spreads momentum over no more
  /// than three leaves in a step of size @p dt (s). In what is stiffer it takes far more than is read wrongly. Empty if there are none.
  /// Collective.
  template <int dim>
  Vector
  bending_nodes(const LiquidDomain<dim> &domain, const double dt);

  /// How a node velocity bends between such nodes. It is the means over faces that are right, and the
  /// nodes of a wave, fitted to them, have more than it: read linearly beside a face it would be too large, so that vortices
  /// without viscosity gain energy. Bent it is too large everywhere by the same part.
  template <int dim>
  class VelocityCurvature
  {
  public:
    /// Of v (m/s), with up-to-date ghosts, between bending_nodes(), which it refers to; without any it is linear. Collective.
    VelocityCurvature(const Mesh<dim> &mesh, const NodeVector<dim> &v, const Vector &bends);

    /// The fields of the components of v with it. Must outlive them.
    std::vector<NodeField<dim>>
    bent(std::vector<NodeField<dim>> fields) const;

    /// What it adds to the mean of the nodes of a face at its centre (m/s).
    Tensor<1, dim>
    at_face(const LocalIndex face) const;

  private:
    const Mesh<dim>             &mesh;
    const Vector                &bends;
    std::vector<NodeVector<dim>> gradient; ///< of each component (1/s); none if it is linear
  };
} // namespace treacle

#endif
