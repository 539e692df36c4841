// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/wetted_walls.h>
#include <treacle/geometry/marching.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    /// The part of a facet where a P1 function is negative at its corners, as a wall of a cell that moves with @p v (m/s).
    template <int dim>
    WettedWall<dim>
    part_of_facet(const Mesh<dim>                   &mesh,
                  const LocalIndex                   cell,
                  const std::array<Point<dim>, dim> &x,
                  const VertexValues<dim - 1>       &phi,
                  const Tensor<1, dim>              &v)
    {
      WettedWall<dim>      wall{{}, negative_fraction<dim - 1>(phi) * area_vector<dim>(x), 0};
      const Tensor<1, dim> from_first = negative_centroid<dim>(x, phi) - mesh.node_position[mesh.cell_nodes[cell][0]];
      wall.swept                      = v * wall.area;
      for (unsigned int i = 0; i <= dim; ++i)
        wall.weight[i] = (i == 0) + mesh.cell_gradients[cell][i] * from_first;
      return wall;
    }

    /// Outside of solids.
    template <int dim>
    WettedWall<dim>
    on_side(const LiquidDomain<dim> &domain, const Vector &phi, const LocalIndex cell, const LocalIndex face)
    {
      const Mesh<dim>            &mesh = domain.mesh;
      std::array<Point<dim>, dim> x;
      VertexValues<dim - 1>       at_corners;
      for (unsigned int i = 0; i < dim; ++i)
        {
          const LocalIndex node = mesh.face_nodes[face][i];
          x[i]                  = mesh.node_position[node];
          at_corners[i]         = std::max(phi.local_element(node), -domain.solid_distance[node]);
        }
      WettedWall<dim> wall = part_of_facet<dim>(mesh, cell, x, at_corners, Tensor<1, dim>());
      if (wall.area * mesh.face_normal[face] < 0)
        wall.area *= -1;
      return wall;
    }

    /// Of the nodes of a cell in solids, in the mean (m/s).
    template <int dim>
    Tensor<1, dim>
    velocity_of_solid(const LiquidDomain<dim> &domain, const LocalIndex cell)
    {
      Tensor<1, dim> sum;
      unsigned int   n = 0;
      for (const LocalIndex node : domain.mesh.cell_nodes[cell])
        if (domain.solid_distance[node] <= 0)
          {
            sum += domain.prescribed[node];
            ++n;
          }
      return sum / n;
    }

    template <int dim>
    void
    append_of_solid(const LiquidDomain<dim>      &domain,
                    const Vector                 &phi,
                    const LocalIndex              cell,
                    std::vector<WettedWall<dim>> &walls)
    {
      const Mesh<dim>        &mesh     = domain.mesh;
      const VertexValues<dim> at_nodes = mesh.values(cell, phi);
      VertexValues<dim>       depth    = mesh.values(cell, domain.solid_distance);
      std::transform(depth.begin(), depth.end(), depth.begin(), std::negate<double>());
      const Facets<dim> facets = surface_facets<dim>(depth);
      for (unsigned int k = 0; k < facets.n; ++k)
        {
          const auto position = [&](const unsigned int i) -> const Point<dim> & {
            return mesh.node_position[mesh.cell_nodes[cell][i]];
          };
          VertexValues<dim - 1> at_corners;
          std::transform(facets.facet[k].begin(), facets.facet[k].end(), at_corners.begin(), [&](const auto &edge) {
            const auto [a, b] = edge;
            return at_nodes[a] + edge_zero(depth[a], depth[b]) * (at_nodes[b] - at_nodes[a]);
          });
          walls.push_back(part_of_facet<dim>(mesh,
                                             cell,
                                             facet_points<dim>(facets.facet[k], depth, position),
                                             at_corners,
                                             velocity_of_solid(domain, cell)));
        }
    }
  } // namespace

  template <int dim>
  std::vector<WettedWall<dim>>
  wetted_walls(const LiquidDomain<dim> &domain, const Vector &phi, const LocalIndex cell)
  {
    std::vector<WettedWall<dim>> walls;
    for (const LocalIndex face : domain.mesh.cell_faces[cell])
      if (domain.mesh.face_side[face] != Mesh<dim>::no_side)
        walls.push_back(on_side(domain, phi, cell, face));
    append_of_solid(domain, phi, cell, walls);
    walls.erase(std::remove_if(walls.begin(), walls.end(), [](const auto &wall) { return wall.area.norm_square() == 0; }),
                walls.end());
    return walls;
  }

  template std::vector<WettedWall<2>>
  wetted_walls(const LiquidDomain<2> &, const Vector &, const LocalIndex);
  template std::vector<WettedWall<3>>
  wetted_walls(const LiquidDomain<3> &, const Vector &, const LocalIndex);
} // namespace treacle
