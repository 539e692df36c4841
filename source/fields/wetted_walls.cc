// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/wetted_walls.h>
#include <treacle/geometry/marching.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    /// The part of a facet where a P1 function is negative at its corners.
    template <int dim>
    struct PartOfFacet
    {
      Tensor<1, dim> area;
      Point<dim>     centre;

      PartOfFacet(const std::array<Point<dim>, dim> &x, const VertexValues<dim - 1> &phi)
        : area(negative_fraction<dim - 1>(phi) * area_vector<dim>(x))
        , centre(negative_centroid<dim>(x, phi))
      {}
    };

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
      const PartOfFacet<dim> part(x, at_corners);
      return {weights_at(mesh, cell, part.centre), part.area.norm() * mesh.face_normal[face], 0};
    }

    /// In a plane, as the distance from it is linear in the cell.
    template <int dim>
    WettedWall<dim>
    of_solid(const LiquidDomain<dim> &domain, const State<dim> &state, const LocalIndex cell)
    {
      const Mesh<dim>        &mesh     = domain.mesh;
      const VertexValues<dim> at_nodes = mesh.values(cell, state.phi);
      VertexValues<dim>       depth    = mesh.values(cell, domain.solid_distance);
      std::transform(depth.begin(), depth.end(), depth.begin(), std::negate<double>());
      const auto position = [&](const unsigned int i) -> const Point<dim> & {
        return mesh.node_position[mesh.cell_nodes[cell][i]];
      };
      Tensor<1, dim>    area, moment;
      const Facets<dim> facets = surface_facets<dim>(depth);
      for (unsigned int k = 0; k < facets.n; ++k)
        {
          VertexValues<dim - 1> at_corners;
          std::transform(facets.facet[k].begin(), facets.facet[k].end(), at_corners.begin(), [&](const auto &edge) {
            const auto [a, b] = edge;
            return at_nodes[a] + edge_zero(depth[a], depth[b]) * (at_nodes[b] - at_nodes[a]);
          });
          const PartOfFacet<dim> part(facet_points<dim>(facets.facet[k], depth, position), at_corners);
          area += part.area;
          moment += part.area.norm() * part.centre;
        }
      if (area.norm() == 0)
        return {};
      const Point<dim> centre(moment / area.norm());
      return {weights_at(mesh, cell, centre), area, domain.scene.solid_velocity(centre, state.time) * area};
    }
  } // namespace

  template <int dim>
  std::vector<WettedWall<dim>>
  wetted_walls(const LiquidDomain<dim> &domain, const State<dim> &state, const LocalIndex cell)
  {
    std::vector<WettedWall<dim>> walls;
    const auto                   append = [&](const WettedWall<dim> &wall) {
      if (wall.area.norm_square() > 0)
        walls.push_back(wall);
    };
    for (const LocalIndex face : domain.mesh.cell_faces[cell])
      if (domain.mesh.face_side[face] != Mesh<dim>::no_side)
        append(on_side(domain, state.phi, cell, face));
    if (domain.scene.has_solids())
      append(of_solid(domain, state, cell));
    return walls;
  }

  template std::vector<WettedWall<2>>
  wetted_walls(const LiquidDomain<2> &, const State<2> &, const LocalIndex);
  template std::vector<WettedWall<3>>
  wetted_walls(const LiquidDomain<3> &, const State<3> &, const LocalIndex);
} // namespace treacle
