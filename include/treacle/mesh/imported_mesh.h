// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_imported_mesh_h
#define treacle_mesh_imported_mesh_h

#include <treacle/mesh/mesh_cells.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// Where the mesh comes from.
  enum class MeshType
  {
    lattice,
    file
  };

  /// A mesh that a file describes.
  template <int dim>
  struct ImportedMesh
  {
    struct Parameters
    {
      MeshType    type = MeshType::lattice;
      std::string file;

      bool
      is_imported() const
      {
        return type == MeshType::file;
      }

      /// Subsection Mesh.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// Rank 0 reads the file and sends each rank its cells. Throws a UserError on
    /// all ranks. Collective.
    ImportedMesh(const MPI_Comm &comm, const std::string &path);

    MeshCells<dim> cells;
    double         mean_size    = 0; ///< of the cells (m)
    double         largest_size = 0;
  };
} // namespace treacle

#endif
