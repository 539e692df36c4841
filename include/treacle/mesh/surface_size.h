// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_surface_size_h
#define treacle_mesh_surface_size_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Leaf edge (m) of a cell that the surface passes through; the finest for an invalid one, in a mesh
  /// from a file the mean cell size.
  template <int dim>
  double
  surface_size_of_cell(const Mesh<dim> &mesh, const LocalIndex cell)
  {
    return mesh.is_lattice() && cell != invalid ? std::min(mesh.cell_size[cell], mesh.surface_size()) :
                               mesh.finest_size();
  }

  /// The same of the smallest cell around an owned node.
  template <int dim>
  double
  surface_size_at_node(const Mesh<dim> &mesh, const LocalIndex node)
  {
    double size = mesh.surface_size();
    for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
      size = std::min(size, surface_size_of_cell(mesh, mesh.node_cells[k]));
    return size;
  }
} // namespace treacle

#endif
