// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_dual_density_h
#define treacle_fields_dual_density_h

#include <treacle/fields/state.h>
#include <treacle/mesh/dual_part.h>
#include <treacle/scene/scene.h>

namespace treacle
{
  /// Along a part of the dual edge of a face, in kg/m^dim. What lies between two dual centres has then in one what slows and what weighs it down: a force with a
  /// potential that acts on layers is the difference of a pressure, and under constant gravity all of a body falls alike. Throws a UserError.
  template <int dim>
  double
  mean_density(const Scene<dim> &scene, const State<dim> &state, const LocalIndex face, const DualPart<dim> &part);
} // namespace treacle

#endif
