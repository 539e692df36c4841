// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/surface/redistance.h>
#include <treacle/surface/surface_distance.h>

namespace treacle
{
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

    /// Cells that the surface cuts, and their nodes.
    struct Cut
    {
      std::vector<unsigned char> cell, node;

      template <int dim>
      Cut(const Mesh<dim> &mesh, const Vector &phi)
        : cell(mesh.cell_nodes.size(), 0)
        , node(mesh.node_position.size(), 0)
      {
        for (LocalIndex c = 0; c < cell.size(); ++c)
          {
            cell[c] = is_cut(mesh, phi, c);
            if (cell[c])
              for (const LocalIndex i : mesh.cell_nodes[c])
                node[i] = 1;
          }
      }
    };

    /// phi at the nodes of cut cells divided by the length of the gradient there: the surface
    /// that the others measure their distance from is the one that stays. Only cut cells tell
    /// the gradient, for near walls the distance of other nodes is that from the surface's
    /// edge.
    template <int dim>
    Vector
    scaled(const Mesh<dim> &mesh, const Vector &phi, const Cut &cut)
    {
      Vector result = phi;
      result.zero_out_ghost_values();
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (cut.node[node])
          {
            const MeanGradient<dim> g =
              mean_gradient(mesh, phi, node, [&](const LocalIndex c) { return cut.cell[c]; });
            // where the directions differ, at kinks and in thin parts, a short gradient
            // says nothing of the distance, and to scale by it would let them grow
            if (g.mean.norm() > 0.95 * g.length)
              result.local_element(node) *=
                std::min(std::max(g.length, 1 - tolerance), 1 + tolerance) / g.length;
          }
      result.update_ghost_values();
      return result;
    }
  } // namespace

  template <int dim>
  void
  redistance(State<dim> &state, const double reach, const std::vector<double> &solid_distance)
  {
    const Mesh<dim>           &mesh = *state.mesh;
    const Cut                  cut(mesh, state.phi);
    Vector                     phi = scaled(mesh, state.phi, cut);
    const SurfaceDistance<dim> surface(mesh, extract_surface(mesh, phi), reach, solid_distance);
    const auto slope = means_at_nodes(mesh, [&](const LocalIndex c) { return cell_gradient(mesh, c, state.phi); });
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        if (cut.node[node])
          continue;
        double      &value = phi.local_element(node);
        const double kept  = std::abs(value) < kept_layers * mesh.surface_size() ?
                               weight_of_kept(slope[node].norm()) :
                               0.;
        if (kept == 1)
          continue;
        const double distance =
          std::min(surface.nearest(mesh.node_position[node], std::abs(value)).distance, reach);
        value = kept * value + (1 - kept) * (value < 0 ? -distance : distance);
      }
    phi.update_ghost_values();
    state.phi = phi;
    state.phi.update_ghost_values();
  }

  template void
  redistance(State<2> &, const double, const std::vector<double> &);
  template void
  redistance(State<3> &, const double, const std::vector<double> &);
} // namespace treacle
