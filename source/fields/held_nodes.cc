// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/held_nodes.h>

namespace treacle
{
  namespace
  {
    /// Bits as Mesh::node_sides, of walls that a cell's liquid touches, or rests on.
    template <int dim>
    unsigned int
    sides_that_touch(const Mesh<dim> &mesh, const Vector &phi, const bool is_pressure_cell, const LocalIndex cell)
    {
      unsigned int sides = 0;
      for (const LocalIndex node : mesh.cell_nodes[cell])
        if (phi.local_element(node) <= 0)
          sides |= mesh.node_sides[node];
      if (is_pressure_cell)
        for (const LocalIndex face : mesh.cell_faces[cell])
          if (mesh.face_side[face] != Mesh<dim>::no_side)
            sides |= 1u << mesh.face_side[face];
      return sides;
    }

    template <int dim>
    Vector
    sides_that_touch(const Mesh<dim> &mesh, const Vector &phi, const std::vector<unsigned char> &is_pressure_cell)
    {
      Vector sides = mesh.zeros(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          if (mesh.node_sides[node] == 0)
            continue;
          unsigned int wet = 0;
          for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
            wet |= sides_that_touch(mesh, phi, is_pressure_cell[mesh.node_cells[k]], mesh.node_cells[k]);
          sides.local_element(node) = wet & mesh.node_sides[node];
        }
      sides.update_ghost_values();
      return sides;
    }
  } // namespace

  template <int dim>
  HeldNodes<dim>
  held_nodes(const Scene<dim>                 &scene,
             const State<dim>                 &state,
             const std::vector<double>        &solid_distance,
             const std::vector<unsigned char> &is_emitter_node,
             const std::vector<unsigned char> &is_pressure_cell)
  {
    constexpr unsigned char all  = (1u << dim) - 1;
    const Mesh<dim>        &mesh = *state.mesh;
    HeldNodes<dim>          held;
    held.constrained.assign(mesh.node_position.size(), 0);
    held.prescribed.assign(mesh.node_position.size(), Tensor<1, dim>());
    const Vector sides = sides_that_touch(mesh, state.phi, is_pressure_cell);
    std::string  error;
    for (LocalIndex node = 0; node < held.constrained.size(); ++node)
      {
        const Point<dim>  &x       = mesh.node_position[node];
        const unsigned int touched = sides.local_element(node);
        for (unsigned int wall = 0; wall < Walls<dim>::n; ++wall)
          if (touched >> wall & 1)
            held.constrained[node] |= scene.no_slip(wall) ? all : 1u << Walls<dim>::axis(wall);
        const bool in_solid = solid_distance[node] <= 0;
        if (!in_solid && !is_emitter_node[node])
          continue;
        held.constrained[node] = all;
        keep_error(error, [&] {
          held.prescribed[node] = in_solid ? scene.solid_velocity(x, state.time) :
                                             scene.emitter_velocity(x, state.time);
        });
      }
    throw_first(mesh.communicator(), error);
    return held;
  }

  template HeldNodes<2>
  held_nodes(const Scene<2> &,
             const State<2> &,
             const std::vector<double> &,
             const std::vector<unsigned char> &,
             const std::vector<unsigned char> &);
  template HeldNodes<3>
  held_nodes(const Scene<3> &,
             const State<3> &,
             const std::vector<double> &,
             const std::vector<unsigned char> &,
             const std::vector<unsigned char> &);
} // namespace treacle
