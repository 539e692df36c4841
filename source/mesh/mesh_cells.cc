// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/mesh_cells.h>

#include <deal.II/grid/reference_cell.h>

namespace treacle
{
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
  TriangulationDescription::Description<dim, dim>
  describe(const MPI_Comm &comm, const MeshCells<dim> &mesh)
  {
    const unsigned int                              n = mesh.cells.size();
    TriangulationDescription::Description<dim, dim> description;
    description.comm      = comm;
    description.settings  = TriangulationDescription::Settings::default_setting;
    description.smoothing = Triangulation<dim>::none;
    description.cell_infos.resize(1);
    description.coarse_cells.resize(n);
    description.cell_infos[0].resize(n);
    for (const auto &vertex : mesh.vertices)
      description.coarse_cell_vertices.push_back(vertex.position);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto &cell = mesh.cells[i];
        description.coarse_cells[i].vertices.assign(cell.vertex.begin(), cell.vertex.end());
        description.coarse_cell_index_to_coarse_cell_id.push_back(cell.id);

        auto &info              = description.cell_infos[0][i];
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
      }
    return description;
  }

#define INSTANTIATE(dim)                                       \
  template unsigned int opposite_vertex<dim>(const unsigned int); \
  template TriangulationDescription::Description<dim, dim> describe( \
    const MPI_Comm &, const MeshCells<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
