// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_cube_grid_h
#define treacle_mesh_cube_grid_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Cubes of one edge that fill a mesh's box, from its lowest corner on.
  template <int dim>
  class CubeGrid
  {
  public:
    /// @p edge in m.
    CubeGrid(const Mesh<dim> &mesh, const double edge)
      : edge(edge)
      , origin(mesh.box().get_boundary_points().first)
    {}

    /// Points below the box are in its lowest cubes.
    LatticePoint<dim>
    cube_of(const Point<dim> &x) const
    {
      LatticePoint<dim> cube;
      for (unsigned int d = 0; d < dim; ++d)
        cube[d] = static_cast<int>(std::max(0., std::floor((x[d] - origin[d]) / edge)));
      return cube;
    }

    BoundingBox<dim>
    box_of(const LatticePoint<dim> &cube) const
    {
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = origin[d] + edge * cube[d];
          upper[d] = lower[d] + edge;
        }
      return BoundingBox<dim>({lower, upper});
    }

    /// Call @p visit with each cube that the box between two corners meets.
    template <typename Visit>
    void
    for_each(const Point<dim> &lower, const Point<dim> &upper, const Visit &visit) const
    {
      const LatticePoint<dim> first = cube_of(lower), last = cube_of(upper);
      for (LatticePoint<dim> cube = first; cube[dim - 1] <= last[dim - 1];)
        {
          visit(cube);
          for (unsigned int d = 0; d < dim; ++d)
            {
              ++cube[d];
              if (cube[d] <= last[d] || d == dim - 1)
                break;
              cube[d] = first[d];
            }
        }
    }

    const double edge;

  private:
    const Point<dim> origin;
  };
} // namespace treacle

#endif
