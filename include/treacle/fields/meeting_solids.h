// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_meeting_solids_h
#define treacle_fields_meeting_solids_h

#include <treacle/mesh/mesh.h>
#include <treacle/scene/scene.h>

#include <optional>

namespace treacle
{
  /// The volume that the walls of solids sweep in a cell where phi, by its @p values at the cell's nodes, is negative, out of what they leave
  /// open (m^dim/s): of each solid the wall outside of the others, with its own velocity. Nothing where no two meet that move
  /// differently: there the nearest solid's velocity does for all. Throws a UserError where a velocity makes no sense.
  template <int dim>
  std::optional<double>
  swept_by_meeting_solids(const Mesh<dim>         &mesh,
                          const Scene<dim>        &scene,
                          const LocalIndex         cell,
                          const VertexValues<dim> &values,
                          const double             time);
} // namespace treacle

#endif
