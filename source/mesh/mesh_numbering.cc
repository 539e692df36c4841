// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/face_normal_element.h>
#include <treacle/mesh/mesh_numbering.h>

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria_description.h>

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
    CellData<dim>
    coarse_cell(const typename MeshCells<dim>::Cell &cell)
    {
      CellData<dim> result;
      result.vertices.assign(cell.vertex.begin(), cell.vertex.end());
      return result;
    }

    template <int dim>
    TriangulationDescription::CellData<dim>
    cell_info(const typename MeshCells<dim>::Cell &cell)
    {
      TriangulationDescription::CellData<dim> info;
      info.id                 = CellId(cell.id, {}).template to_binary<dim>();
      info.subdomain_id       = cell.owner;
      info.level_subdomain_id = cell.owner;
      info.manifold_id        = numbers::flat_manifold_id;
      info.manifold_line_ids.fill(numbers::flat_manifold_id);
      info.manifold_quad_ids.fill(numbers::flat_manifold_id);
      for (unsigned int f = 0; f <= dim; ++f)
        if (const unsigned char wall = cell.wall[opposite_vertex<dim>(f)];
            wall != Walls<dim>::none)
          info.boundary_ids.emplace_back(f, wall);
      return info;
    }

    template <int dim>
    TriangulationDescription::Description<dim, dim>
    describe(const MPI_Comm &comm, const MeshCells<dim> &mesh)
    {
      TriangulationDescription::Description<dim, dim> description;
      description.comm      = comm;
      description.settings  = TriangulationDescription::Settings::default_setting;
      description.smoothing = Triangulation<dim>::none;
      description.cell_infos.resize(1);
      for (const auto &vertex : mesh.vertices)
        description.coarse_cell_vertices.push_back(vertex.position);
      for (const auto &cell : mesh.cells)
        {
          description.coarse_cells.push_back(coarse_cell<dim>(cell));
          description.coarse_cell_index_to_coarse_cell_id.push_back(cell.id);
          description.cell_infos[0].push_back(cell_info<dim>(cell));
        }
      return description;
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

    /// The place of each cell that deal.II knows by its id.
    template <int dim>
    std::unordered_map<GlobalIndex, unsigned int>
    index_by_id(const MeshCells<dim> &mesh)
    {
      std::unordered_map<GlobalIndex, unsigned int> index_of;
      index_of.reserve(mesh.cells.size());
      for (unsigned int i = 0; i < mesh.cells.size(); ++i)
        index_of[mesh.cells[i].id] = i;
      return index_of;
    }

    template <int dim>
    std::array<LocalIndex, dim + 1>
    local_indices(const typename Triangulation<dim>::cell_iterator &cell,
                  const DoFHandler<dim>                            &dofs,
                  const Utilities::MPI::Partitioner                &partitioner)
    {
      std::vector<GlobalIndex> numbers(dim + 1);
      typename DoFHandler<dim>::active_cell_iterator(*cell, &dofs)->get_dof_indices(numbers);
      std::array<LocalIndex, dim + 1> result;
      for (unsigned int v = 0; v <= dim; ++v)
        result[v] = partitioner.global_to_local(numbers[v]);
      return result;
    }
  } // namespace

  template <int dim>
  MeshNumbering<dim>::MeshNumbering(const MPI_Comm &comm, const MeshCells<dim> &mesh)
    : cells(partitioner_of_cells(comm, mesh))
    , cell(mesh.cells.size())
    , cell_nodes(mesh.cells.size())
    , cell_faces(mesh.cells.size())
  {
    parallel::fullydistributed::Triangulation<dim> triangulation(comm);
    triangulation.create_triangulation(describe(comm, mesh));
    DoFHandler<dim> node_dofs(triangulation), face_dofs(triangulation);
    node_dofs.distribute_dofs(FE_SimplexP<dim>(1));
    face_dofs.distribute_dofs(FaceNormalElement<dim>());
    nodes = partitioner_of(comm, node_dofs);
    faces = partitioner_of(comm, face_dofs);

    const auto index_of = index_by_id(mesh);
    for (const auto &accessor : triangulation.active_cell_iterators())
      if (!accessor->is_artificial())
        {
          const GlobalIndex  id      = accessor->id().get_coarse_cell_id();
          const unsigned int i       = index_of.at(id);
          const auto         by_face = local_indices<dim>(accessor, face_dofs, *faces);
          cell[i]       = cells->global_to_local(id);
          cell_nodes[i] = local_indices<dim>(accessor, node_dofs, *nodes);
          for (unsigned int f = 0; f <= dim; ++f)
            cell_faces[i][opposite_vertex<dim>(f)] = by_face[f];
        }
  }

  template struct MeshNumbering<2>;
  template struct MeshNumbering<3>;
} // namespace treacle
