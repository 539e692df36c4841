// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_liquid_surface_h
#define treacle_io_liquid_surface_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// The surface of the liquid as it is written: that of { phi < 0 } outside solids,
  /// with phi and the solid distance P1 in a cell, near films in parts of cells (CellParts).
  /// It is closed along solids and open on the box; area_vector() of a facet points out of the liquid.
  template <int dim>
  struct LiquidSurface
  {
    struct Vertex
    {
      /// Of the corners that the vertex lies between, in ascending order: two, or three
      /// where the surface meets a solid. Of each the keys of the nodes that it is between, and how many quarters of the way;
      /// of a node twice, and 0. The rest is no_key. The last entry says what vanishes there: 1 phi, 2 the solid distance, 3 both.
      std::array<VertexKey, 10> keys;
      std::array<double, 3>    position; ///< z = 0 in 2D
      std::array<float, 3>     velocity;
    };

    static constexpr VertexKey no_key = ~VertexKey(0);

    using Facet = std::array<std::int32_t, dim>;

    std::vector<Vertex> vertices;
    std::vector<Facet>  facets;             ///< vertex indices
    bool                in_doubles = false; ///< floats have too few digits for the positions
  };

  /// The whole surface on rank 0, in an order that no partition changes. Collective.
  template <int dim>
  LiquidSurface<dim>
  gather_liquid_surface(const State<dim> &state, const LiquidDomain<dim> &domain);
} // namespace treacle

#endif
