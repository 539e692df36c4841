// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/cut_cells.h>

#include <algorithm>
#include <numeric>

namespace treacle
{
  namespace
  {
    /// Part of an edge that at least stays open, lest parts have no volume.
    constexpr double least_open = 1e-3;
    /// Of a cell's volume.
    constexpr double least_part = 1e-10;

    /// The same for a cell on all ranks, and on a face for both its cells.
    template <int dim>
    std::array<unsigned int, dim + 1>
    by_position(const Simplex<dim> &x)
    {
      std::array<unsigned int, dim + 1> order;
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const unsigned int i, const unsigned int j) {
        return std::lexicographical_compare(
          x[i].begin_raw(), x[i].end_raw(), x[j].begin_raw(), x[j].end_raw());
      });
      return order;
    }
  } // namespace

  template <int dim>
  void
  CutCells<dim>::append_parts(const Simplex<dim>      &x,
                              const VertexValues<dim> &psi,
                              const double             least_volume,
                              const Scene<dim>        &scene,
                              const double             time)
  {
    const Parts<dim> parts = negative_parts<dim>(psi, by_position<dim>(x));
    for (unsigned int k = 0; k < parts.n; ++k)
      {
        Part         part;
        Simplex<dim> corners;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const auto [i, j] = parts.corners[k][v];
            corners[v]        = x[i];
            part.vertex[v]    = i;
            if (i == j)
              continue;
            corners[v] += std::max(psi[i] / (psi[i] - psi[j]), least_open) * (x[j] - x[i]);
            part.vertex[v]   = on_wall;
            part.velocity[v] = scene.solid_velocity(corners[v], time);
          }
        part.fraction = std::abs(signed_volume<dim>(corners));
        if (part.fraction < least_volume) // flat where the wall meets a node
          continue;
        part.gradient = basis_gradients<dim>(corners);
        all.push_back(part);
      }
  }

  template <int dim>
  CutCells<dim>::CutCells(const Mesh<dim>           &mesh,
                          const Scene<dim>          &scene,
                          const std::vector<double> &solid_distance,
                          const double               time)
    : volume(mesh.cell_nodes.size(), 0.)
  {
    start.reserve(mesh.cell_nodes.size() + 1);
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      {
        start.push_back(all.size());
        VertexValues<dim> psi;
        for (unsigned int i = 0; i <= dim; ++i)
          psi[i] = -solid_distance[mesh.cell_nodes[c][i]];
        const auto [least, largest] = std::minmax_element(psi.begin(), psi.end());
        if (*least >= 0 || *largest <= 0)
          continue;
        append_parts(mesh.cell_vertices(c), psi, least_part * mesh.cell_volume[c], scene, time);
        Assert(all.size() > start.back(), ExcMessage("A cut cell without an open part."));
        for (unsigned int k = start.back(); k < all.size(); ++k)
          volume[c] += all[k].fraction;
        for (unsigned int k = start.back(); k < all.size(); ++k)
          all[k].fraction /= volume[c];
      }
    start.push_back(all.size());
  }

  template class CutCells<2>;
  template class CutCells<3>;
} // namespace treacle
