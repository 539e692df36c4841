// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_mesh_numbering_h
#define treacle_mesh_mesh_numbering_h

#include <treacle/mesh/mesh_cells.h>

#include <deal.II/base/partitioner.h>

#include <memory>

namespace treacle
{
  /// Numbers of nodes, faces and cells over all ranks, and what each rank holds of them. Cells share a face if they have
  /// its vertices.
  template <int dim>
  struct MeshNumbering
  {
    using Partitioner = std::shared_ptr<const Utilities::MPI::Partitioner>;

    /// Collective.
    MeshNumbering(const MPI_Comm &comm, const MeshCells<dim> &mesh);

    Partitioner nodes, faces, cells;

    // -- of each of the mesh's cells, in its order --
    std::vector<LocalIndex>                      cell;       ///< its place among cells
    std::vector<std::array<LocalIndex, dim + 1>> cell_nodes; ///< of its vertices
    std::vector<std::array<LocalIndex, dim + 1>> cell_faces; ///< opposite them
  };
} // namespace treacle

#endif
