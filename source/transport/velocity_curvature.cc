// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/transport/velocity_curvature.h>

namespace treacle
{
  template <int dim>
  Vector
  bending_nodes(const LiquidDomain<dim> &domain, const double dt)
  {
    constexpr double full = 1 - 1e-9; // of a cell
    constexpr double most = 10;       // squares of a leaf
    const Mesh<dim> &mesh = domain.mesh;
    Vector           bends(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      bends.local_element(node) = std::all_of(
        mesh.node_cells.begin() + mesh.node_cell_start[node],
        mesh.node_cells.begin() + mesh.node_cell_start[node + 1],
        [&](const LocalIndex c) {
          return domain.liquid_volume[c] > full * mesh.cell_volume[c] &&
                 domain.viscosity[c] * dt < most * domain.density[c] * mesh.cell_size[c] * mesh.cell_size[c];
        });
    if (bends.linfty_norm() == 0)
      return {};
    bends.update_ghost_values();
    return bends;
  }

  template <int dim>
  VelocityCurvature<dim>::VelocityCurvature(const Mesh<dim> &mesh, const NodeVector<dim> &v, const Vector &bends)
    : mesh(mesh)
    , bends(bends)
  {
    if (bends.size() == 0)
      return;
    gradient.assign(dim, NodeVector<dim>(mesh.nodes));
    const auto mean = means_at_nodes(mesh, [&](const LocalIndex c) { return velocity_gradient(mesh, c, v); });
    for (unsigned int d = 0; d < dim; ++d)
      {
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          gradient[d].set(node, mean[node][d]);
        gradient[d].update_ghost_values();
      }
  }

  template <int dim>
  std::vector<NodeField<dim>>
  VelocityCurvature<dim>::bent(std::vector<NodeField<dim>> fields) const
  {
    for (unsigned int d = 0; d < gradient.size(); ++d)
      {
        fields[d].gradient    = &gradient[d];
        fields[d].smoothness  = &bends;
        fields[d].is_distance = false;
      }
    return fields;
  }

  template <int dim>
  Tensor<1, dim>
  VelocityCurvature<dim>::at_face(const LocalIndex face) const
  {
    if (gradient.empty())
      return {};
    const auto             &nodes = mesh.face_nodes[face];
    std::array<double, dim> weight;
    std::transform(nodes.begin(), nodes.end(), weight.begin(), [this](const LocalIndex node) {
      return bends.local_element(node) / dim;
    });
    Tensor<1, dim> above;
    for (unsigned int d = 0; d < dim; ++d)
      above[d] = above_plane(mesh, nodes, weight, gradient[d]);
    return above;
  }

  template Vector bending_nodes(const LiquidDomain<2> &, const double);
  template Vector bending_nodes(const LiquidDomain<3> &, const double);
  template class VelocityCurvature<2>;
  template class VelocityCurvature<3>;
} // namespace treacle
