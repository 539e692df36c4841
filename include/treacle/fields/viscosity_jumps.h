// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_viscosity_jumps_h
#define treacle_fields_viscosity_jumps_h

#include <treacle/fields/state.h>
#include <treacle/scene/scene.h>

namespace treacle
{
  /// In cells in which the viscosity jumps, by the scene's formula or in the material that the liquid
  /// carries, that of the cell (Pa s) becomes a mean over the cell's liquid, softer than the harmonic
  /// one. Throws a UserError on all ranks where a viscosity makes no sense. Collective.
  template <int dim>
  void
  soften_jumps(const Scene<dim>          &scene,
               const State<dim>          &state,
               const std::vector<double> &solid_distance,
               const std::vector<double> &liquid_volume,
               std::vector<double>       &viscosity);
} // namespace treacle

#endif
