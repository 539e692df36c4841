// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_wall_part_h
#define treacle_geometry_wall_part_h

#include <treacle/geometry/simplex.h>

namespace treacle
{
  /// The part of a wall where a P1 function is negative.
  template <int dim>
  struct WallPart
  {
    Tensor<1, dim> area; ///< along the normal (m^(dim-1))
    Point<dim>     centre;
  };

  /// Of a facet with the vertices @p x and the function's values there.
  template <int dim>
  WallPart<dim>
  wall_part(const std::array<Point<dim>, dim> &x, const VertexValues<dim - 1> &phi);

  /// Of the plane in a right-handed simplex where the @p depth in a solid is zero; the normal leads into that.
  template <int dim>
  WallPart<dim>
  wall_part(const Simplex<dim> &x, const VertexValues<dim> &depth, const VertexValues<dim> &phi);
} // namespace treacle

#endif
