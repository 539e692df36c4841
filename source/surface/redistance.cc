// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/surface/redistance.h>
#include <treacle/surface/surface_distance.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    struct MeanGradient
    {
      Tensor<1, dim> mean;
      double         length = 0; ///< the mean of the lengths
    };

    /// Volume-weighted means over the cells around an owned node that @p counts
    /// holds for.
    template <int dim, typename Counts>
    MeanGradient<dim>
    mean_gradient(const Mesh<dim>  &mesh,
                  const Vector     &field,
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
          Tensor<1, dim> g;
          for (unsigned int i = 0; i <= dim; ++i)
            g += field.local_element(mesh.cell_nodes[c][i]) * mesh.cell_gradients[c][i];
          volume += mesh.cell_volume[c];
          result.mean += mesh.cell_volume[c] * g;
          result.length += mesh.cell_volume[c] * g.norm();
        }
      result.mean /= volume;
      result.length /= volume;
      return result;
    }

    bool
    all_cells(const LocalIndex)
    {
      return true;
    }
  } // namespace

  template <int dim>
  NodeVector<dim>
  nodal_gradient(const Mesh<dim> &mesh, const Vector &field)
  {
    NodeVector<dim> gradient(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      gradient.set(node, mean_gradient(mesh, field, node, all_cells).mean);
    gradient.update_ghost_values();
    return gradient;
  }

  namespace
  {
    /// The facets of a curved surface are chords: distances from them are off by
    /// h^2/8R, and the mean gradient is shorter than 1 by as much. Where phi is a
    /// distance well enough it is left alone, or the error would add up (a disc of
    /// radius 6.4 h that moves by 2.9 h in 20 steps: volume +5e-3, not 2e-4).
    constexpr double kept_layers = 3;

    /// How far the length of a gradient may be from 1 where phi is left alone; beyond
    /// twice as much it is replaced, and in between blended, lest kinks appear.
    constexpr double tolerance = 0.05;

    double
    weight_of_kept(const double length)
    {
      return std::min(1., std::max(0., 2 - std::abs(length - 1) / tolerance));
    }
  } // namespace

  template <int dim>
  void
  redistance(State<dim> &state, const double reach)
  {
    const Mesh<dim>              &mesh = *state.mesh;

    // divide by the length of the gradient first: the surface that the others
    // measure their distance from is the one that stays. Only cut cells tell the
    // gradient, for near walls the distance of other nodes is that from the
    // surface's edge
    std::vector<unsigned char> is_cut_cell(mesh.cell_nodes.size(), 0);
    std::vector<unsigned char> is_cut(mesh.node_position.size(), 0);
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      {
        unsigned int n_negative = 0;
        for (const LocalIndex node : mesh.cell_nodes[c])
          n_negative += state.phi.local_element(node) < 0;
        is_cut_cell[c] = n_negative > 0 && n_negative <= dim;
        if (is_cut_cell[c])
          for (const LocalIndex node : mesh.cell_nodes[c])
            is_cut[node] = 1;
      }
    Vector phi = state.phi;
    phi.zero_out_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (is_cut[node])
        {
          const MeanGradient<dim> g =
            mean_gradient(mesh, state.phi, node, [&](const LocalIndex c) { return is_cut_cell[c]; });
          // where the directions differ, at kinks and in thin parts, a short gradient
          // says nothing of the distance, and to scale by it would let them grow
          if (g.mean.norm() > 0.95 * g.length)
            phi.local_element(node) *=
              std::min(std::max(g.length, 1 - tolerance), 1 + tolerance) / g.length;
        }
    phi.update_ghost_values();

    const SurfaceDistance<dim> surface(mesh, phi, reach);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        if (is_cut[node])
          continue;
        double      &value = phi.local_element(node);
        const double kept =
          std::abs(value) < kept_layers * mesh.surface_size() ?
            weight_of_kept(mean_gradient(mesh, state.phi, node, all_cells).mean.norm()) :
            0.;
        if (kept == 1)
          continue;
        const double distance =
          std::min(surface.nearest(mesh.node_position[node]).distance, reach);
        value = kept * value + (1 - kept) * (value < 0 ? -distance : distance);
      }
    phi.update_ghost_values();
    state.phi = phi;
    state.phi.update_ghost_values();
  }

  template NodeVector<2>
  nodal_gradient(const Mesh<2> &, const Vector &);
  template NodeVector<3>
  nodal_gradient(const Mesh<3> &, const Vector &);
  template void
  redistance(State<2> &, const double);
  template void
  redistance(State<3> &, const double);
} // namespace treacle
