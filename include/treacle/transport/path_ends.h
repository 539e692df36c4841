// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_path_ends_h
#define treacle_transport_path_ends_h

#include <treacle/fields/face_node.h>
#include <treacle/mesh/tracer.h>

namespace treacle
{
  /// Nodes and centres of faces of a mesh, where paths end; with a cell and the velocity there, if they lead through the same mesh.
  template <int dim>
  class PathEnds
  {
  public:
    std::vector<Point<dim>>     x;
    Guesses                     cells;
    std::vector<Tensor<1, dim>> velocity; ///< m/s

    /// Of @p mesh. Paths lead through @p passed, and have at its nodes the velocity @p v at their end. Both must outlive this object.
    PathEnds(const Mesh<dim> &mesh, const Mesh<dim> &passed, const NodeVector<dim> &v)
      : mesh(mesh)
      , v(&mesh == &passed ? &v : nullptr)
    {}

    void
    add_node(const LocalIndex node)
    {
      x.push_back(mesh.node_position[node]);
      if (v == nullptr)
        return;
      cells.push_back(mesh.node_cells[mesh.node_cell_start[node]]);
      velocity.push_back(v->value(node));
    }

    void
    add_face(const LocalIndex face)
    {
      x.push_back(mesh.face_centre(face));
      if (v == nullptr)
        return;
      cells.push_back(std::min(mesh.face_cells[face][0], mesh.face_cells[face][1]));
      velocity.push_back(mean_at_face(mesh, *v, face));
    }

  private:
    const Mesh<dim>       &mesh;
    const NodeVector<dim> *v; ///< null in another mesh
  };
} // namespace treacle

#endif
