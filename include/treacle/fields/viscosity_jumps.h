// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_viscosity_jumps_h
#define treacle_fields_viscosity_jumps_h

#include <treacle/fields/cut_cells.h>
#include <treacle/fields/state.h>
#include <treacle/fields/viscosity_jump.h>
#include <treacle/scene/scene.h>

#include <map>

namespace treacle
{
  /// In cells in which the viscosity jumps, by the scene's formula or in the material that the liquid
  /// carries, that of the cell (Pa s) becomes a mean over the cell's liquid, softer than the harmonic
  /// one. Returns where it jumps in those that no solid cuts and where it can be told. Throws a UserError on all
  /// ranks where a viscosity makes no sense. Collective.
  template <int dim>
  std::map<LocalIndex, ViscosityJump<dim>>
  soften_jumps(const Scene<dim>          &scene,
               const State<dim>          &state,
               const std::vector<double> &solid_distance,
               const CutCells<dim>       &cut_cells,
               const std::vector<double> &liquid_volume,
               std::vector<double>       &viscosity);
} // namespace treacle

#endif
