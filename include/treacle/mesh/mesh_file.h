// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_mesh_file_h
#define treacle_mesh_mesh_file_h

#include <treacle/mesh/mesh_cells.h>

#include <deal.II/grid/tria.h>

namespace treacle
{
  /// The triangles or tetrahedra of a mesh file, on the one rank that reads it.
  template <int dim>
  struct MeshFile
  {
    /// Reads the file, checks the mesh, and parts it with METIS. Throws a UserError
    /// that names the file.
    MeshFile(const std::string &path, const unsigned int n_ranks);

    std::vector<Point<dim>>                         vertices;
    std::vector<std::array<unsigned int, dim + 1>>  cells; ///< right-handed
    std::vector<std::array<unsigned int, dim + 1>>  neighbours; ///< opposite each vertex, or invalid
    std::vector<std::array<unsigned char, dim + 1>> walls;      ///< opposite each vertex
    std::vector<unsigned short>                     vertex_walls;
    std::vector<unsigned int>                       rank_of; ///< for each cell

  private:
    void
    part(Triangulation<dim> &triangulation, const unsigned int n_ranks);

    void
    orient_cells();

    void
    find_neighbours();

    void
    check_connected() const;

    void
    find_walls();

    void
    check_walls() const;

    /// The vertices opposite vertex v of a cell.
    std::array<unsigned int, dim>
    facet(const unsigned int cell, const unsigned int v) const;

    std::array<Point<dim>, dim>
    positions(const std::array<unsigned int, dim> &facet) const;

    /// Throw a UserError about the mesh at a point.
    [[noreturn]] void
    fail(const std::string &problem, const Point<dim> &x) const;

    std::string path;
  };
} // namespace treacle

#endif
