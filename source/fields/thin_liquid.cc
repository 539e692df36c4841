// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/thin_liquid.h>
#include <treacle/mesh/surface_size.h>

#include <algorithm>

namespace treacle
{
  template <int dim>
  Vector
  within_layers(const MeshData<dim> &data, const Vector &phi, Vector is_deep, const unsigned int n_layers)
  {
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        is_deep.update_ghost_values();
        Vector next = is_deep;
        next.zero_out_ghost_values();
        for (LocalIndex node = 0; node < data.mesh.n_owned_nodes(); ++node)
          if (phi.local_element(node) < 0)
            for (const auto &[other, n_cells] : data.neighbours(node))
              next.local_element(node) = std::max(next.local_element(node), is_deep.local_element(other));
        is_deep = next;
      }
    is_deep.update_ghost_values();
    return is_deep;
  }

  template <int dim>
  double
  thin_part(const LiquidDomain<dim> &domain, const Vector &phi)
  {
    constexpr double       depth    = 0.35; // leaves: in a sheet of one there is a node as deep, wherever it lies
    constexpr unsigned int n_layers = 2;    // the corners of a thick body are thick
    const Mesh<dim>       &mesh     = domain.mesh;
    Vector                 is_deep(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      is_deep.local_element(node) =
        domain.solid_distance[node] > 0 && phi.local_element(node) < -depth * surface_size_at_node(mesh, node);
    const Vector is_thick = within_layers(domain.data, phi, is_deep, n_layers);

    double thin = 0, all = 0;
    for (LocalIndex cell = 0; cell < mesh.n_owned_cells(); ++cell)
      {
        const auto &nodes = mesh.cell_nodes[cell];
        all += domain.liquid_volume[cell];
        if (std::none_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) { return is_thick.local_element(node) > 0; }))
          thin += domain.liquid_volume[cell];
      }
    all = Utilities::MPI::sum(all, mesh.communicator());
    return all > 0 ? Utilities::MPI::sum(thin, mesh.communicator()) / all : 0.;
  }

  template Vector
  within_layers(const MeshData<2> &, const Vector &, Vector, const unsigned int);
  template Vector
  within_layers(const MeshData<3> &, const Vector &, Vector, const unsigned int);
  template double
  thin_part(const LiquidDomain<2> &, const Vector &);
  template double
  thin_part(const LiquidDomain<3> &, const Vector &);
} // namespace treacle
