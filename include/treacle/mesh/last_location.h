// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_last_location_h
#define treacle_mesh_last_location_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Where to look first for points of which no cell is known, in an order in which neighbours often follow one another: a walk from the
  /// cell of the one before costs less than a search.
  template <int dim>
  class LastLocation
  {
  public:
    explicit LastLocation(const Mesh<dim> &mesh)
      : squared_reach(std::pow(2 * mesh.finest_size(), 2))
    {}

    /// A cell of this rank, or invalid.
    LocalIndex
    guess(const Point<dim> &x) const
    {
      return x.distance_square(point) < squared_reach ? cell : invalid;
    }

    void
    set(const Point<dim> &x, const LocalIndex cell_of_x)
    {
      point = x;
      cell  = cell_of_x;
    }

  private:
    const double squared_reach;
    Point<dim>   point;
    LocalIndex   cell = invalid;
  };
} // namespace treacle

#endif
