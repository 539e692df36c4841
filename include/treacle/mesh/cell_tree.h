// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_cell_tree_h
#define treacle_mesh_cell_tree_h

#include <treacle/base/types.h>

#include <deal.II/numerics/rtree.h>

namespace treacle
{
  /// Which cells may contain a point of a mesh that has no lattice, which wall is
  /// nearest to it, and which ranks to ask about it.
  template <int dim>
  class CellTree
  {
  public:
    /// A facet on a wall of the mesh, and its cell.
    struct WallFacet
    {
      std::array<Point<dim>, dim> x;
      LocalIndex                  cell;
    };

    /// @p cells: boxes of the cells of this rank; @p walls in an order that no
    /// partition changes; @p ranks: boxes around the cells of each rank, which
    /// must outlive this object.
    CellTree(const std::vector<BoundingBox<dim>>              &cells,
             const std::vector<WallFacet>                     &walls,
             const std::vector<std::vector<BoundingBox<dim>>> &ranks);

    /// The cells whose box contains x.
    void
    cells_around(const Point<dim> &x, std::vector<LocalIndex> &result) const;

    struct Nearest
    {
      double     distance; ///< m; infinite if this rank has no wall
      Point<dim> point;    ///< on a wall
      LocalIndex cell;
    };

    /// On the walls of this rank; the first of those that are equally near.
    Nearest
    nearest_on_walls(const Point<dim> &x) const;

    /// The ranks that may have cells no farther from x than @p distance, or than the
    /// nearest ones must be.
    void
    ranks_around(const Point<dim> &x, double distance, std::vector<unsigned int> &result) const;

    /// Around the cells of all ranks.
    const BoundingBox<dim> &
    box() const
    {
      return around;
    }

  private:
    const BoundingBox<dim> around;

  public:
    const double tolerance; ///< of distances (m)

  private:
    using Entry = std::pair<BoundingBox<dim>, unsigned int>;

    const std::vector<WallFacet>                      walls;
    const std::vector<std::vector<BoundingBox<dim>>> &rank_boxes;
    RTree<Entry>                                      cell_boxes, wall_boxes;
  };
} // namespace treacle

#endif
