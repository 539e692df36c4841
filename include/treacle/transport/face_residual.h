// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_face_residual_h
#define treacle_transport_face_residual_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// What the nodes do not know of the old velocity of some owned faces, u - P v, is added to what they have
  /// of it in a step of @p dt on the same mesh, @p u: as long as the liquid does not get from one face to the
  /// next. Dropped in each step, it would be lost the faster the smaller the steps are.
  template <int dim>
  void
  keep_what_nodes_miss(const State<dim>              &old,
                       const LiquidDomain<dim>       &domain,
                       const double                   dt,
                       const std::vector<LocalIndex> &faces,
                       Vector                        &u);
} // namespace treacle

#endif
