// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/rank_triangulation.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    /// deal.II knows no triangulation without a cell: where this rank has none, one that
    /// nobody owns.
    template <int dim>
    std::vector<Point<dim>>
    vertices_of_nothing()
    {
      std::vector<Point<dim>> vertices(dim + 1);
      for (unsigned int d = 0; d < dim; ++d)
        vertices[d + 1][d] = 1;
      return vertices;
    }
  } // namespace

  template <int dim>
  RankTriangulation<dim>::RankTriangulation(const MPI_Comm &comm, const MeshCells<dim> &mesh)
    : parallel::DistributedTriangulationBase<dim>(comm)
    , mesh_cells(mesh.cells)
  {
    std::vector<Point<dim>> vertices;
    vertices.reserve(mesh.vertices.size());
    for (const auto &vertex : mesh.vertices)
      vertices.push_back(vertex.position);
    std::vector<CellData<dim>> cells(mesh_cells.size());
    for (unsigned int i = 0; i < cells.size(); ++i)
      cells[i].vertices.assign(mesh_cells[i].vertex.begin(), mesh_cells[i].vertex.end());
    if (cells.empty())
      {
        vertices = vertices_of_nothing<dim>();
        cells.emplace_back(dim + 1);
        std::iota(cells[0].vertices.begin(), cells[0].vertices.end(), 0);
      }
    this->create_triangulation(vertices, cells, SubCellData());
    for (const auto &cell : this->active_cell_iterators())
      cell->set_subdomain_id(mesh_cells.empty() ? numbers::artificial_subdomain_id :
                                                  mesh_cells[cell->index()].owner);
    this->update_number_cache();
  }

  template <int dim>
  unsigned int
  RankTriangulation<dim>::coarse_cell_id_to_coarse_cell_index(const types::coarse_cell_id id) const
  {
    const auto it = std::lower_bound(
      mesh_cells.begin(), mesh_cells.end(), id, [](const auto &cell, const types::coarse_cell_id other) {
        return cell.id < other;
      });
    return it == mesh_cells.end() || it->id != id ? numbers::invalid_unsigned_int :
                                                    it - mesh_cells.begin();
  }

  template <int dim>
  types::coarse_cell_id
  RankTriangulation<dim>::coarse_cell_index_to_coarse_cell_id(const unsigned int index) const
  {
    return mesh_cells.empty() ? numbers::invalid_coarse_cell_id : mesh_cells[index].id;
  }

  template <int dim>
  void
  RankTriangulation<dim>::save(const std::string &) const
  {
    AssertThrow(false, ExcNotImplemented());
  }

  template <int dim>
  void
  RankTriangulation<dim>::load(const std::string &)
  {
    AssertThrow(false, ExcNotImplemented());
  }

  template <int dim>
  void
  RankTriangulation<dim>::load(const std::string &, const bool)
  {
    AssertThrow(false, ExcNotImplemented());
  }

  template class RankTriangulation<2>;
  template class RankTriangulation<3>;
} // namespace treacle
