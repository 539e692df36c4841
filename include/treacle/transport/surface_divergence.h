// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_surface_divergence_h
#define treacle_transport_surface_divergence_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// The projection keeps the volume that flows through faces; a node velocity fitted to
  /// them and continued into the air does not, and where the surface is curved as sharply
  /// as a leaf, as about a stream that enters a pool, it loses a third of what flows
  /// there. This takes the divergence of v out of the liquid within two leaves of the
  /// surface: the least change of its nodes, in the mean over the liquid, after which the
  /// mean of div v over the liquid of their cells with each P1 weight is zero,
  ///
  ///   v - M^-1 B^T q,   (B M^-1 B^T + 0.1 L) q = B v,
  ///
  /// with (B v)_i the integral of lambda_i div v, M the lumped volume of the liquid, and
  /// L the stiffness of q, without which weights that alternate from node to node are
  /// hardly seen. As the weights sum to one, and L q to zero, what flows through the
  /// surface is right as a whole. Components that are prescribed stay. Not in gaps
  /// between liquid thinner than a cell, whose air is to go, nor beside emitters. v
  /// (m/s), phi (m) and its gradient at nodes, with up-to-date ghosts before and after.
  /// Collective.
  template <int dim>
  void
  remove_divergence_at_surface(const Vector            &phi,
                               const NodeVector<dim>   &gradient,
                               const LiquidDomain<dim> &domain,
                               NodeVector<dim>         &v);
} // namespace treacle

#endif
