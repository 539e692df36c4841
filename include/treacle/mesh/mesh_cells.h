// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_mesh_cells_h
#define treacle_mesh_mesh_cells_h

#include <treacle/base/types.h>

#include <vector>

namespace treacle
{
  /// Kinds of walls: sides of the box 2 axis + upper; then walls inside the box
  /// that are normal to an axis; then all others.
  template <int dim>
  struct Walls
  {
    static constexpr unsigned char inner   = 2 * dim; ///< + axis
    static constexpr unsigned char oblique = 3 * dim;
    static constexpr unsigned char n       = 3 * dim + 1;
    static constexpr unsigned char none    = 255;

    /// That a wall which is not oblique is normal to.
    static constexpr unsigned int
    axis(const unsigned int wall)
    {
      return wall < inner ? wall / 2 : wall - inner;
    }
  };

  /// What a Mesh is made of on one rank: its own cells, all that share a vertex
  /// with one of them, and their vertices.
  template <int dim>
  struct MeshCells
  {
    struct Vertex
    {
      VertexKey      key; ///< the same on all ranks
      Point<dim>     position;
      double         weight; ///< m^2
      unsigned short walls;  ///< bit w: on a wall of kind w
    };

    struct Cell
    {
      GlobalIndex                       id; ///< each rank owns a range of them
      GlobalIndex                       number; ///< in an order that no partition changes
      unsigned int                      owner;
      double                            size;   ///< edge of a leaf that has such cells (m)
      std::array<unsigned int, dim + 1> vertex; ///< right-handed
      std::array<unsigned char, dim + 1> wall;  ///< opposite each vertex
    };

    std::vector<Cell>   cells; ///< in the order of their ids
    std::vector<Vertex> vertices;
  };
} // namespace treacle

#endif
