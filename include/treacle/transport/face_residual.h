// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_face_residual_h
#define treacle_transport_face_residual_h

#include <treacle/fields/backward_difference.h>
#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/state.h>

namespace treacle
{
  /// The owned faces that may carry liquid: a node of them is in it, or will be once markers have
  /// corrected phi.
  template <int dim>
  std::vector<LocalIndex>
  faces_that_matter(const State<dim> &state);

  /// What the nodes do not know of the velocity of faces, u - P v (m/s): of owned liquid faces, others
  /// have 0.
  template <int dim>
  Vector
  missed_by_nodes(const State<dim> &state, const LiquidDomain<dim> &domain);

  /// The same of the faces of the next state that matter: NaN where its mesh is new and this one has no such face. Collective.
  template <int dim>
  Vector
  missed_by_nodes(const State<dim> &state, const LiquidDomain<dim> &domain, const State<dim> &next);

  /// Of faces with a node where @p blow is not 0 what nodes miss was before what it is now.
  template <int dim>
  void
  forget_missed(State<dim> &state, const LiquidDomain<dim> &domain, const Vector &blow);

  /// What the nodes do not know of the old velocity of some owned faces of a @p mesh, in the manner of the backward
  /// difference, is added to what they have of it, @p u: as long as the liquid does
  /// not get from one face to the next. Dropped in each step, it would be lost the faster the smaller the
  /// steps are. Faces that the old mesh did not have get nothing, those where leaves change size along the surface no more than smooth flows
  /// have: waves would grow there. Collective.
  template <int dim>
  void
  keep_what_nodes_miss(const State<dim>              &old,
                       const LiquidDomain<dim>       &domain,
                       const BackwardDifference      &difference,
                       const Mesh<dim>               &mesh,
                       const std::vector<LocalIndex> &faces,
                       Vector                        &u);
} // namespace treacle

#endif
