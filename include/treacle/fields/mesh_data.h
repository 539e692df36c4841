// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_mesh_data_h
#define treacle_fields_mesh_data_h

#include <treacle/mesh/mesh.h>
#include <treacle/scene/scene.h>

#include <deal.II/base/array_view.h>

#include <optional>

namespace treacle
{
  /// What a mesh and the scene have in common, computed once for each mesh: neighbours of
  /// nodes, distances to solids.
  template <int dim>
  class MeshData
  {
  public:
    /// Both must outlive this object.
    MeshData(const Mesh<dim> &mesh, const Scene<dim> &scene);

    MeshData(const MeshData &) = delete;

    const Mesh<dim>  &mesh;
    const Scene<dim> &scene;

    struct Neighbour
    {
      LocalIndex   node;
      unsigned int n_cells; ///< that both have
    };

    /// Of an owned node, itself among them.
    ArrayView<const Neighbour>
    neighbours(const LocalIndex node) const
    {
      return ArrayView<const Neighbour>(all_neighbours.data() + start[node],
                                        start[node + 1] - start[node]);
    }

    /// Signed distance of the nodes, owned and ghost, to the solids at a time, positive
    /// outside them (m); those of solids at rest are computed once. The reference is good until
    /// another time is asked for.
    const std::vector<double> &
    solid_distance(const double time) const;

    /// Where the nodal gradient (fields/gradients.h) of a quadratic function is the true one: in the middle of the cells around each
    /// node, which is not the node at sides of the box and beside coarser leaves. Computed when first asked for, then collective.
    const NodeVector<dim> &
    points_of_gradient() const;

  private:
    void
    find_neighbours();

    std::vector<unsigned int> start; ///< of each owned node in all_neighbours, and the end
    std::vector<Neighbour>    all_neighbours;
    std::vector<double>       from_resting; ///< solids
    mutable std::vector<double> from_all;
    mutable double              last_time;
    mutable std::optional<NodeVector<dim>> gradient_points;
  };

  /// Is a predicate true of an owned node or of a neighbour of it?
  template <int dim, typename Predicate>
  bool
  any_around(const MeshData<dim> &data, const LocalIndex node, const Predicate &is)
  {
    const auto neighbours = data.neighbours(node);
    return is(node) ||
           std::any_of(neighbours.begin(), neighbours.end(), [&](const auto &neighbour) { return is(neighbour.node); });
  }

  /// The mean of @p value (other node) over the neighbours of an owned node that
  /// @p counts holds for, each as often as they share a cell; false if there are none.
  template <int dim, typename Counts, typename Value, typename Result>
  bool
  mean_of_neighbours(const MeshData<dim> &data,
                     const LocalIndex     node,
                     const Counts        &counts,
                     const Value         &value,
                     Result              &mean)
  {
    unsigned int n = 0;
    mean           = Result();
    for (const auto &neighbour : data.neighbours(node))
      if (counts(neighbour.node))
        {
          mean += static_cast<double>(neighbour.n_cells) * value(neighbour.node);
          n += neighbour.n_cells;
        }
    if (n > 0)
      mean /= n;
    return n > 0;
  }
} // namespace treacle

#endif
