// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_liquid_volume_h
#define treacle_fields_liquid_volume_h

#include <treacle/fields/mesh_data.h>

namespace treacle
{
  /// Is there any in a cell, but for solids? Most have none.
  template <int dim>
  bool
  has_liquid(const Mesh<dim> &mesh, const Vector &phi, const LocalIndex cell)
  {
    for (const LocalIndex node : mesh.cell_nodes[cell])
      if (phi.local_element(node) < 0)
        return true;
    return false;
  }

  /// Volume of { phi < 0 } outside solids over all ranks (m^dim); @p phi with
  /// up-to-date ghosts.
  template <int dim>
  double
  liquid_volume(const MeshData<dim> &data, const Vector &phi, const double time);
} // namespace treacle

#endif
