// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/surface/surface.h>

namespace treacle
{
  template <int dim>
  Surface<dim>
  extract_surface(const Mesh<dim> &mesh, const Vector &phi)
  {
    Surface<dim>                                    surface;
    std::unordered_map<std::uint64_t, unsigned int> index;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        if (!is_cut(mesh, phi, c))
          continue;
        const auto values = mesh.values(c, phi);
        const auto facets = surface_facets<dim>(values);
        for (unsigned int k = 0; k < facets.n; ++k)
          {
            std::array<unsigned int, dim> facet;
            for (unsigned int i = 0; i < dim; ++i)
              {
                LocalIndex a = mesh.cell_nodes[c][facets.facet[k][i][0]];
                LocalIndex b = mesh.cell_nodes[c][facets.facet[k][i][1]];
                if (mesh.node_key[a] > mesh.node_key[b])
                  std::swap(a, b);
                const auto [it, is_new] =
                  index.emplace(static_cast<std::uint64_t>(a) << 32 | b, surface.vertices.size());
                if (is_new)
                  {
                    const double t = edge_zero(phi.local_element(a), phi.local_element(b));
                    surface.vertices.push_back({a, b, t});
                    surface.positions.push_back(
                      mesh.node_position[a] + t * (mesh.node_position[b] - mesh.node_position[a]));
                  }
                facet[i] = it->second;
              }
            surface.facets.push_back(facet);
          }
      }
    return surface;
  }

  template Surface<2>
  extract_surface(const Mesh<2> &, const Vector &);
  template Surface<3>
  extract_surface(const Mesh<3> &, const Vector &);
} // namespace treacle
