// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_emission_h
#define treacle_surface_emission_h

#include <treacle/fields/full_container.h>
#include <treacle/fields/mesh_data.h>
#include <treacle/fields/parcel.h>
#include <treacle/fields/state.h>

namespace treacle
{
  /// Fills the emitters that were at work in the step of size @p dt that ends at
  /// state.time, and those that start there: level set, markers and carried material. The skin of a stream along the wall it comes from
  /// is removed. Returns what flowed in, less what flowed out in drains, by the cells of this rank,
  /// which is less than the emitter's volume rate where the liquid around
  /// it takes part in the motion, and, unless solids may make some, no more than there is room for. Collective.
  template <int dim>
  std::vector<Parcel<dim>>
  emit(State<dim> &state, const MeshData<dim> &data, const double dt, const Room &room);
} // namespace treacle

#endif
