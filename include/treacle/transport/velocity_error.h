// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_velocity_error_h
#define treacle_transport_velocity_error_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/state.h>

namespace treacle
{
  /// A place (m) after a step, and the largest leaf edge (m) there.
  template <int dim>
  struct AskedSize
  {
    Point<dim> x;
    double     size;
  };

  /// What the velocity asks for in the cells of the liquid, those that solids cut aside, moved on with it for
  /// @p dt: leaves twice as large would change it by Mesh/Velocity error of the largest speed. With the
  /// second derivatives D v, from nodal means of gradients, edges of h and 2 h differ by 3/8 h^2 |D v| at most.
  /// Collective.
  template <int dim>
  std::vector<AskedSize<dim>>
  sizes_by_velocity(const State<dim> &state, const LiquidDomain<dim> &domain, const double dt);
} // namespace treacle

#endif
