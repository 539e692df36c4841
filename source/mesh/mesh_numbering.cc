// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/face_normal_element.h>
#include <treacle/mesh/mesh_numbering.h>
#include <treacle/mesh/rank_triangulation.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/reference_cell.h>

namespace treacle
{
  namespace
  {
    /// The vertex of a simplex that is opposite deal.II's face f.
    template <int dim>
    unsigned int
    opposite_vertex(const unsigned int f)
    {
      const auto   reference = ReferenceCells::get_simplex<dim>();
      unsigned int opposite  = dim * (dim + 1) / 2;
      for (unsigned int v = 0; v < dim; ++v)
        opposite -= reference.face_to_cell_vertices(f, v, 1);
      return opposite;
    }

    template <int dim>
    std::shared_ptr<const Utilities::MPI::Partitioner>
    partitioner_of_cells(const MPI_Comm &comm, const MeshCells<dim> &mesh)
    {
      const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
      const auto         is_mine = [&](const auto &cell) { return cell.owner == rank; };
      const GlobalIndex  n_owned = std::count_if(mesh.cells.begin(), mesh.cells.end(), is_mine);
      GlobalIndex        first   = 0;
      MPI_Exscan(&n_owned, &first, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, comm);
      const GlobalIndex n_cells = Utilities::MPI::sum(n_owned, comm);
      IndexSet          owned(n_cells), ghosts(n_cells);
      owned.add_range(first, first + n_owned);
      std::vector<GlobalIndex> ids;
      for (const auto &cell : mesh.cells)
        if (!is_mine(cell))
          ids.push_back(cell.id);
      ghosts.add_indices(ids.begin(), ids.end());
      return std::make_shared<const Utilities::MPI::Partitioner>(owned, ghosts, comm);
    }

    template <int dim>
    std::shared_ptr<const Utilities::MPI::Partitioner>
    partitioner_of(const MPI_Comm &comm, const DoFHandler<dim> &dofs)
    {
      IndexSet relevant;
      DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      return std::make_shared<const Utilities::MPI::Partitioner>(
        dofs.locally_owned_dofs(), relevant, comm);
    }
  } // namespace

  template <int dim>
  MeshNumbering<dim>::MeshNumbering(const MPI_Comm &comm, const MeshCells<dim> &mesh)
    : cells(partitioner_of_cells(comm, mesh))
    , cell(mesh.cells.size())
    , cell_nodes(mesh.cells.size())
    , cell_faces(mesh.cells.size())
  {
    const RankTriangulation<dim> triangulation(comm, mesh);
    DoFHandler<dim>              node_dofs(triangulation), face_dofs(triangulation);
    node_dofs.distribute_dofs(FE_SimplexP<dim>(1));
    face_dofs.distribute_dofs(FaceNormalElement<dim>());
    nodes = partitioner_of(comm, node_dofs);
    faces = partitioner_of(comm, face_dofs);

    std::array<unsigned int, dim + 1> opposite;
    for (unsigned int f = 0; f <= dim; ++f)
      opposite[f] = opposite_vertex<dim>(f);
    std::vector<GlobalIndex> of_nodes(dim + 1), of_faces(dim + 1);
    for (const auto &accessor : node_dofs.active_cell_iterators())
      if (!accessor->is_artificial())
        {
          const unsigned int i = accessor->index();
          cell[i]              = cells->global_to_local(mesh.cells[i].id);
          accessor->get_dof_indices(of_nodes);
          typename DoFHandler<dim>::active_cell_iterator(&triangulation, 0, i, &face_dofs)
            ->get_dof_indices(of_faces);
          for (unsigned int k = 0; k <= dim; ++k)
            {
              cell_nodes[i][k]           = nodes->global_to_local(of_nodes[k]);
              cell_faces[i][opposite[k]] = faces->global_to_local(of_faces[k]);
            }
        }
  }

  template struct MeshNumbering<2>;
  template struct MeshNumbering<3>;
} // namespace treacle
