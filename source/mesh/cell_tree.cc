// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/distance.h>
#include <treacle/geometry/nearest_point.h>
#include <treacle/mesh/cell_tree.h>

#include <limits>

namespace treacle
{
  namespace bgi = boost::geometry::index;

  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    template <int dim>
    BoundingBox<dim>
    box_around(const std::vector<std::vector<BoundingBox<dim>>> &boxes)
    {
      std::vector<Point<dim>> corners;
      for (const auto &list : boxes)
        for (const BoundingBox<dim> &box : list)
          {
            corners.push_back(box.get_boundary_points().first);
            corners.push_back(box.get_boundary_points().second);
          }
      return BoundingBox<dim>(corners);
    }

    /// Distances from x to the nearest and the farthest point of a box.
    template <int dim>
    std::pair<double, double>
    distances(const Point<dim> &x, const BoundingBox<dim> &box)
    {
      double nearest = 0, farthest = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double below = box.lower_bound(d) - x[d], above = x[d] - box.upper_bound(d);
          const double outside = std::max(0., std::max(below, above));
          const double across  = std::max(std::abs(below), std::abs(above));
          nearest += outside * outside;
          farthest += across * across;
        }
      return {std::sqrt(nearest), std::sqrt(farthest)};
    }
  } // namespace

  template <int dim>
  CellTree<dim>::CellTree(const std::vector<BoundingBox<dim>>              &cells,
                          const std::vector<WallFacet>                     &walls,
                          const std::vector<std::vector<BoundingBox<dim>>> &ranks)
    : around(box_around(ranks))
    , tolerance(rounding_in(around))
    , walls(walls)
    , rank_boxes(ranks)
  {
    std::vector<Entry> entries;
    for (const BoundingBox<dim> &box : cells)
      entries.emplace_back(box, entries.size());
    cell_boxes = pack_rtree(entries);
    entries.clear();
    for (const WallFacet &facet : walls)
      entries.emplace_back(
        BoundingBox<dim>(std::vector<Point<dim>>(facet.x.begin(), facet.x.end())), entries.size());
    wall_boxes = pack_rtree(entries);
  }

  template <int dim>
  void
  CellTree<dim>::cells_around(const Point<dim> &x, std::vector<LocalIndex> &result) const
  {
    result.clear();
    for (const auto &[box, cell] : cell_boxes | bgi::adaptors::queried(bgi::intersects(x)))
      result.push_back(cell);
  }

  template <int dim>
  typename CellTree<dim>::Nearest
  CellTree<dim>::nearest_on_walls(const Point<dim> &x) const
  {
    // boxes in the order of their distance, more of them until no other can hold a
    // nearer facet
    Nearest            best{infinity, x, invalid};
    unsigned int       best_facet = invalid;
    std::vector<Entry> boxes;
    for (unsigned int k = 8; !wall_boxes.empty(); k *= 8)
      {
        boxes.clear();
        wall_boxes.query(bgi::nearest(x, k), std::back_inserter(boxes));
        double farthest = 0;
        for (const auto &[box, facet] : boxes)
          {
            farthest                  = std::max(farthest, distances(x, box).first);
            const Point<dim> p        = nearest_point(walls[facet].x, x);
            const double     distance = p.distance(x);
            if (distance < best.distance - tolerance ||
                (distance <= best.distance + tolerance && facet < best_facet))
              {
                best       = {distance, p, walls[facet].cell};
                best_facet = facet;
              }
          }
        if (boxes.size() < k || farthest > best.distance + tolerance)
          break;
      }
    return best;
  }

  template <int dim>
  void
  CellTree<dim>::ranks_around(const Point<dim>          &x,
                              double                     distance,
                              std::vector<unsigned int> &result) const
  {
    std::vector<double> nearest(rank_boxes.size(), infinity);
    for (unsigned int r = 0; r < rank_boxes.size(); ++r)
      for (const BoundingBox<dim> &box : rank_boxes[r])
        {
          const auto [near, far] = distances(x, box);
          nearest[r]             = std::min(nearest[r], near);
          distance               = std::min(distance, far);
        }
    result.clear();
    for (unsigned int r = 0; r < nearest.size(); ++r)
      if (nearest[r] <= distance + tolerance)
        result.push_back(r);
  }

  template class CellTree<2>;
  template class CellTree<3>;
} // namespace treacle
