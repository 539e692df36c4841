// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/surface_size.h>
#include <treacle/surface/chords.h>

namespace treacle
{
  namespace
  {
    /// In leaves: a radius of a leaf, beyond which chords are what is left of a surface; and of fifty to a hundred, which noise has: small
    /// waves would swing and calm down by it, at rates up to 4 % off.
    constexpr double highest = 1. / 16, lowest = 1e-3;

    /// In the mean over a cell. For a quadratic function f with the Hessian H, the linear one less f is the sum of
    /// lambda_i lambda_j e_ij H e_ij / 2 over the edges e_ij, and lambda_i lambda_j is 1 / ((n + 1) (n + 2)) in the mean. Along its gradient a distance is
    /// linear: what changes there is a kink, as in the middle of a sheet, and does not count.
    template <int dim>
    double
    height_in_cell(const Mesh<dim> &mesh, const LocalIndex c, const NodeVector<dim> &gradient, const NodeVector<dim> &point)
    {
      constexpr double nearest = 0.3, kink = 0.1; // of an edge, that its gradients are apart; length of the mean gradient
      const auto      &nodes   = mesh.cell_nodes[c];
      double           sum     = 0;
      Tensor<1, dim>   normal;
      for (const LocalIndex node : nodes)
        normal += gradient.value(node) / (dim + 1);
      if (normal.norm() < kink)
        return 0;
      normal /= normal.norm();
      for (unsigned int i = 0; i <= dim; ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const LocalIndex     a = nodes[i], b = nodes[j];
            const Tensor<1, dim> e     = mesh.node_position[b] - mesh.node_position[a];
            const double         apart = (point.value(b) - point.value(a)) * e / e.norm_square();
            if (apart > nearest)
              sum += (gradient.value(b) - gradient.value(a)) * (e - (e * normal) * normal) / apart;
          }
      return sum / (2 * (dim + 1) * (dim + 2));
    }
  } // namespace

  template <int dim>
  std::vector<double>
  heights_above_chords(const MeshData<dim> &data, const Vector &phi, const NodeVector<dim> &gradient, const double deep)
  {
    const Mesh<dim>       &mesh  = data.mesh;
    const NodeVector<dim> &point = data.points_of_gradient();
    const double           far   = deep * largest_surface_size(mesh);
    std::vector<double>    height(mesh.n_owned_nodes()), volume(height.size());
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      {
        const VertexValues<dim> values = mesh.values(c, phi);
        if (std::all_of(values.begin(), values.end(), [&](const double value) { return std::abs(value) > far; }))
          continue;
        const double part = mesh.cell_volume[c] * height_in_cell(mesh, c, gradient, point);
        for (const LocalIndex node : mesh.cell_nodes[c])
          if (node < height.size())
            {
              height[node] += part;
              volume[node] += mesh.cell_volume[c];
            }
      }
    for (LocalIndex node = 0; node < height.size(); ++node)
      {
        const double h = surface_size_at_node(mesh, node), distance = std::abs(phi.local_element(node));
        const double mean = distance < deep * h ? height[node] / volume[node] : 0;
        const double low  = std::clamp(mean, -lowest * h, lowest * h);
        height[node]      = std::clamp(mean - low, -highest * h, highest * h);
      }
    return height;
  }

  template std::vector<double>
  heights_above_chords(const MeshData<2> &, const Vector &, const NodeVector<2> &, const double);
  template std::vector<double>
  heights_above_chords(const MeshData<3> &, const Vector &, const NodeVector<3> &, const double);
} // namespace treacle
