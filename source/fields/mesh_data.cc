// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/mesh_data.h>

namespace treacle
{
  namespace
  {
    /// A wall along nodes is one, whatever rounding says.
    template <int dim>
    void
    snap_to_nodes(const Mesh<dim> &mesh, std::vector<double> &distance)
    {
      for (double &d : distance)
        if (std::abs(d) < 1e-10 * mesh.finest_size())
          d = 0;
    }
  } // namespace

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
    if (!scene.has_moving_solids())
      snap_to_nodes(mesh, from_resting);
  }

  template <int dim>
  const NodeVector<dim> &
  MeshData<dim>::points_of_gradient() const
  {
    if (!gradient_points)
      {
        Vector half_square(mesh.nodes); // its gradient is x
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          half_square.local_element(node) = 0.5 * mesh.node_position[node].square();
        half_square.update_ghost_values();
        gradient_points = nodal_gradient(mesh, half_square);
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
        snap_to_nodes(mesh, from_all);
        last_time = time;
      }
    return from_all;
  }

  template class MeshData<2>;
  template class MeshData<3>;
} // namespace treacle
