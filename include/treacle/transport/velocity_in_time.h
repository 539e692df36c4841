// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_velocity_in_time_h
#define treacle_transport_velocity_in_time_h

#include <treacle/fields/backward_difference.h>

namespace treacle
{
  /// a v + b w, with ghosts. Collective.
  template <int dim>
  NodeVector<dim>
  combined(const double a, const NodeVector<dim> &v, const double b, const NodeVector<dim> &w)
  {
    NodeVector<dim> result = v;
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.component[d].zero_out_ghost_values();
        result.component[d].sadd(a, b, w.component[d]);
      }
    result.update_ghost_values();
    return result;
  }

  /// After a part of the step: as steady as it was before it.
  template <int dim>
  NodeVector<dim>
  velocity_after(const double              part_of_step,
                 const State<dim>         &old,
                 const BackwardDifference &difference)
  {
    const double part =
      difference.before == 0 ? 0. : part_of_step * difference.dt / old.before->dt;
    return combined(1 + part, old.v, -part, part == 0 ? old.v : *old.before->v);
  }
} // namespace treacle

#endif
