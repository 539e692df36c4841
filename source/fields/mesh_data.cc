// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/mesh_data.h>

namespace treacle
{
  template <int dim>
  MeshData<dim>::MeshData(const Mesh<dim> &mesh, const Scene<dim> &scene)
    : mesh(mesh)
    , scene(scene)
    , last_time(std::numeric_limits<double>::quiet_NaN())
  {
    find_neighbours();
    from_resting.reserve(mesh.node_position.size());
    for (const Point<dim> &x : mesh.node_position)
      from_resting.push_back(scene.resting_solid_distance(x));
  }

  template <int dim>
  const NodeVector<dim> &
  MeshData<dim>::points_of_gradient() const
  {
    if (!gradient_points)
      {
        const Point<dim> origin = mesh.middle(); // far from that of the coordinates squares have no digits left
        Vector           half_square(mesh.nodes); // its gradient is x
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          half_square.local_element(node) = 0.5 * (mesh.node_position[node] - origin).norm_square();
        half_square.update_ghost_values();
        gradient_points = nodal_gradient(mesh, half_square);
        for (unsigned int d = 0; d < dim; ++d)
          gradient_points->component[d].add(origin[d]);
      }
    return *gradient_points;
  }

  template <int dim>
  void
  MeshData<dim>::find_neighbours()
  {
    start.reserve(mesh.n_owned_nodes() + 1);
    std::vector<LocalIndex> around;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        around.clear();
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          around.insert(around.end(),
                        mesh.cell_nodes[mesh.node_cells[k]].begin(),
                        mesh.cell_nodes[mesh.node_cells[k]].end());
        // in an order that no partition changes, for sums depend on it
        std::sort(around.begin(), around.end(), [&](const LocalIndex a, const LocalIndex b) {
          return mesh.node_key[a] < mesh.node_key[b];
        });
        start.push_back(all_neighbours.size());
        for (const LocalIndex other : around)
          if (all_neighbours.size() > start.back() && all_neighbours.back().node == other)
            ++all_neighbours.back().n_cells;
          else
            all_neighbours.push_back({other, 1});
      }
    start.push_back(all_neighbours.size());
    all_neighbours.shrink_to_fit();
  }

  template <int dim>
  const std::vector<double> &
  MeshData<dim>::solid_distance(const double time) const
  {
    if (!scene.has_moving_solids())
      return from_resting;
    if (time != last_time)
      {
        from_all = from_resting;
        for (LocalIndex node = 0; node < from_all.size(); ++node)
          from_all[node] = std::min(from_all[node],
                                    scene.moving_solid_distance(mesh.node_position[node], time));
        last_time = time;
      }
    return from_all;
  }

  template class MeshData<2>;
  template class MeshData<3>;
} // namespace treacle
