// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_surface_size_h
#define treacle_mesh_surface_size_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Edge (m) of the largest leaves that the surface may pass through; in a mesh from a file the mean cell
  /// size.
  template <int dim>
  double
  largest_surface_size(const Mesh<dim> &mesh)
  {
    return mesh.is_lattice() ? mesh.surface_size() : mesh.finest_size();
  }

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
    double size = largest_surface_size(mesh);
    for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
      size = std::min(size, surface_size_of_cell(mesh, mesh.node_cells[k]));
    return size;
  }
} // namespace treacle

#endif
