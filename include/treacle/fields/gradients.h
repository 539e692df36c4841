// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_gradients_h
#define treacle_fields_gradients_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Of the node velocity v in a cell (1/s): [component][direction].
  template <int dim>
  Tensor<2, dim>
  velocity_gradient(const Mesh<dim> &mesh, const LocalIndex cell, const NodeVector<dim> &v)
  {
    Tensor<2, dim> result;
    for (unsigned int i = 0; i <= dim; ++i)
      result += outer_product(v.value(mesh.cell_nodes[cell][i]), mesh.cell_gradients[cell][i]);
    return result;
  }

  /// Of a P1 field in a cell: a Vector, or a vector of numbers at all nodes.
  template <int dim, typename Field>
  Tensor<1, dim>
  cell_gradient(const Mesh<dim> &mesh, const LocalIndex cell, const Field &field)
  {
    const VertexValues<dim> values = mesh.values(cell, field);
    Tensor<1, dim>          g;
    for (unsigned int i = 0; i <= dim; ++i)
      g += values[i] * mesh.cell_gradients[cell][i];
    return g;
  }

  /// With which the values of P1 functions at the nodes of a cell give those at a point, beyond the cell too.
  template <int dim>
  VertexValues<dim>
  weights_at(const Mesh<dim> &mesh, const LocalIndex cell, const Point<dim> &x)
  {
    const Tensor<1, dim> from_first = x - mesh.node_position[mesh.cell_nodes[cell][0]];
    VertexValues<dim>    weights;
    for (unsigned int i = 0; i <= dim; ++i)
      weights[i] = (i == 0) + mesh.cell_gradients[cell][i] * from_first;
    return weights;
  }

  /// The volume-weighted mean of @p value (cell) over the cells around an owned node that @p counts
  /// holds for; false if there are none.
  template <int dim, typename Counts, typename Value, typename Result>
  bool
  mean_of_cells(const Mesh<dim>  &mesh,
                const LocalIndex  node,
                const Counts     &counts,
                const Value      &value,
                Result           &mean)
  {
    double volume = 0;
    mean          = Result();
    for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
      if (const LocalIndex c = mesh.node_cells[k]; counts(c))
        {
          mean += mesh.cell_volume[c] * value(c);
          volume += mesh.cell_volume[c];
        }
    if (volume > 0)
      mean /= volume;
    return volume > 0;
  }

  template <int dim>
  struct MeanGradient
  {
    Tensor<1, dim> mean;
    double         length = 0; ///< the mean of the lengths
  };

  /// Of a P1 field, volume-weighted means over the cells around an owned node that
  /// @p counts holds for.
  template <int dim, typename Field, typename Counts>
  MeanGradient<dim>
  mean_gradient(const Mesh<dim>  &mesh,
                const Field      &field,
                const LocalIndex  node,
                const Counts     &counts)
  {
    MeanGradient<dim> result;
    double            volume = 0;
    for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
      {
        const LocalIndex c = mesh.node_cells[k];
        if (!counts(c))
          continue;
        const Tensor<1, dim> g = cell_gradient(mesh, c, field);
        volume += mesh.cell_volume[c];
        result.mean += mesh.cell_volume[c] * g;
        result.length += mesh.cell_volume[c] * g.norm();
      }
    result.mean /= volume;
    result.length /= volume;
    return result;
  }

  /// The same over all cells around the node.
  template <int dim, typename Field>
  MeanGradient<dim>
  mean_gradient(const Mesh<dim> &mesh, const Field &field, const LocalIndex node)
  {
    return mean_gradient(mesh, field, node, [](const LocalIndex) { return true; });
  }

  /// The volume-weighted means of @p value (cell) over all cells around each node; of ghosts only what is known here.
  template <int dim, typename Value>
  auto
  means_at_nodes(const Mesh<dim> &mesh, const Value &value)
  {
    std::vector<std::decay_t<decltype(value(LocalIndex()))>> mean(mesh.node_position.size());
    std::vector<double>                                      volume(mean.size());
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      {
        const auto part = mesh.cell_volume[c] * value(c);
        for (const LocalIndex node : mesh.cell_nodes[c])
          {
            mean[node] += part;
            volume[node] += mesh.cell_volume[c];
          }
      }
    for (LocalIndex node = 0; node < mean.size(); ++node)
      mean[node] /= volume[node];
    return mean;
  }

  /// Gradient of a P1 field at the nodes, the volume-weighted mean over the cells
  /// around each: exact for linear fields. Ghosts of the result are up to date.
  template <int dim>
  NodeVector<dim>
  nodal_gradient(const Mesh<dim> &mesh, const Vector &field)
  {
    const auto mean = means_at_nodes(mesh, [&](const LocalIndex c) { return cell_gradient(mesh, c, field); });
    NodeVector<dim> gradient(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      gradient.set(node, mean[node]);
    gradient.update_ghost_values();
    return gradient;
  }
} // namespace treacle

#endif
