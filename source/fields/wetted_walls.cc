// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/meeting_solids.h>
#include <treacle/fields/wetted_walls.h>
#include <treacle/geometry/wall_part.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
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
      const WallPart<dim> part = wall_part<dim>(x, at_corners);
      return {weights_at(mesh, cell, part.centre), part.area.norm() * mesh.face_normal[face], 0};
    }

    /// In a plane, as the distance from it is linear in the cell.
    template <int dim>
    WettedWall<dim>
    of_solid(const LiquidDomain<dim> &domain, const State<dim> &state, const LocalIndex cell)
    {
      const Mesh<dim>        &mesh  = domain.mesh;
      const VertexValues<dim> phi   = mesh.values(cell, state.phi);
      VertexValues<dim>       depth = mesh.values(cell, domain.solid_distance);
      std::transform(depth.begin(), depth.end(), depth.begin(), std::negate<double>());
      const WallPart<dim> part = wall_part<dim>(mesh.cell_vertices(cell), depth, phi);
      if (part.area.norm() == 0)
        return {};
      const auto   meeting = domain.closed_excess.count(cell) > 0 ? swept_by_meeting_solids(mesh, domain.scene, cell, phi, state.time) : std::nullopt;
      const double swept   = meeting ? *meeting : domain.scene.solid_velocity(part.centre, state.time) * part.area;
      return {weights_at(mesh, cell, part.centre), part.area, swept};
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
