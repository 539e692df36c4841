// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_emitter_divergence_h
#define treacle_surface_emitter_divergence_h

#include <treacle/fields/mesh_data.h>
#include <treacle/fields/parcel.h>

namespace treacle
{
  /// How much liquid emitters make in a time @p dt (m^dim), by the cells of this rank that they fill, in which nothing else has a part in the
  /// motion: negative where their velocity converges, or goes into walls and solids. So much more flows out of them than into them. Not what
  /// their velocity takes off a wall, which comes out of that. By emitters at a @p time in the step,
  /// @p to_emitters (m) from the nodes, and solids at its @p end. Collective.
  template <int dim>
  std::vector<Parcel<dim>>
  made_in_emitters(const MeshData<dim>       &data,
                   const std::vector<double> &to_emitters,
                   const double               end,
                   const double               time,
                   const double               dt);
} // namespace treacle

#endif
