// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/transport/time_step.h>
#include <treacle/transport/velocity_error.h>

namespace treacle
{
  namespace
  {
    /// Of a finest leaf, in a step: what moves by less is at rest but for noise.
    constexpr double least_motion = 1e-6;

    /// The velocity gradient at nodes, by component: the mean of the cells around that count. What is as short
    /// as a cell, as the errors of the velocity are, is gone. Collective.
    template <int dim, typename Counts>
    std::vector<NodeVector<dim>>
    mean_gradient(const State<dim> &state, const Counts &counts)
    {
      const Mesh<dim>             &mesh = *state.mesh;
      std::vector<NodeVector<dim>> result(dim, NodeVector<dim>(mesh.nodes));
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          Tensor<2, dim> mean;
          mean_of_cells(
            mesh,
            node,
            counts,
            [&](const LocalIndex c) { return velocity_gradient(mesh, c, state.v); },
            mean);
          for (unsigned int d = 0; d < dim; ++d)
            result[d].set(node, mean[d]);
        }
      for (NodeVector<dim> &of_component : result)
        of_component.update_ghost_values();
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<AskedSize<dim>>
  sizes_by_velocity(const State<dim> &state, const LiquidDomain<dim> &domain, const double dt)
  {
    const Mesh<dim>            &mesh = *state.mesh;
    std::vector<AskedSize<dim>> result;
    if (!mesh.is_lattice() || mesh.octree().parameters().velocity_error == 0)
      return result;
    const double bound =
      mesh.octree().parameters().velocity_error *
      std::max(maximum_speed(state, domain), least_motion * mesh.finest_size() / dt);
    const auto counts = [&](const LocalIndex c) {
      return domain.liquid_volume[c] > 0 && domain.cut_cells.parts(c).size() == 0;
    };
    const std::vector<NodeVector<dim>> gradient = mean_gradient(state, counts);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (counts(c))
        {
          double square = 0; // of the second derivatives
          for (const NodeVector<dim> &of_component : gradient)
            square += velocity_gradient(mesh, c, of_component).norm_square();
          const double size = std::sqrt(bound / (3. / 8 * std::sqrt(square)));
          Point<dim> x;
          for (const LocalIndex node : mesh.cell_nodes[c])
            x += (mesh.node_position[node] + dt * state.v.value(node)) / (dim + 1);
          result.push_back({x, size});
        }
    return result;
  }

  template std::vector<AskedSize<2>>
  sizes_by_velocity(const State<2> &, const LiquidDomain<2> &, const double);
  template std::vector<AskedSize<3>>
  sizes_by_velocity(const State<3> &, const LiquidDomain<3> &, const double);
} // namespace treacle
