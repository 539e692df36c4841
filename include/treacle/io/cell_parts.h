// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_cell_parts_h
#define treacle_io_cell_parts_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/surface/films.h>

#include <functional>

namespace treacle
{
  /// Cells for the surface that is written: whole, and near films divided at the points of edges that films cut: longer edges
  /// first, then in an order of all edges, so that cells and ranks agree on their faces.
  template <int dim>
  class CellParts
  {
  public:
    /// A node, or a point of an edge between two.
    struct Corner
    {
      std::array<LocalIndex, 2> ends; ///< in the order of their keys; of a node twice
      std::array<VertexKey, 3>  key;  ///< of the ends, and how many Films<dim>::n_parts of the way
      Point<dim>                x;    ///< m
      Tensor<1, dim>            v;    ///< m/s
      double                    phi, solid; ///< of the liquid, and minus the distance to solids (m)

      bool
      is_node() const
      {
        return ends[0] == ends[1];
      }
    };

    using Simplex = std::array<Corner, dim + 1>;

    /// Collective.
    CellParts(const State<dim> &state, const LiquidDomain<dim> &domain);

    /// Call @p visit with each part of one of this rank's cells that may hold liquid.
    void
    for_each_part(const LocalIndex cell, const std::function<void(const Simplex &)> &visit);

  private:
    /// What two corners have between them on the edge of a cell.
    struct Between
    {
      std::tuple<std::int64_t, VertexKey, VertexKey, VertexKey> place; ///< among all
      std::array<unsigned int, 2>                               corners;
      std::array<LocalIndex, 2>                                 ends;
      double                                                    phi;
    };

    Corner
    corner(const LocalIndex node) const;

    /// If they are both on an edge that is to be divided in their middle.
    std::optional<Between>
    between(const Simplex &simplex, const unsigned int i, const unsigned int j);

    void
    divide(const Simplex &simplex, const std::function<void(const Simplex &)> &visit);

    const State<dim>        &state;
    const LiquidDomain<dim> &domain;
    const Mesh<dim>         &mesh;
    Films<dim>               films;
  };
} // namespace treacle

#endif
