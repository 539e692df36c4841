// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_covering_boxes_h
#define treacle_mesh_covering_boxes_h

#include <treacle/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <vector>

namespace treacle
{
  /// Boxes around consecutive runs of things, which end at @p ends: a few tight ones say more than
  /// one around all. @p append (i, points) adds the corners of thing i.
  template <int dim, typename Append>
  std::vector<BoundingBox<dim>>
  covering_boxes(const std::vector<unsigned int> &ends, const Append &append)
  {
    std::vector<BoundingBox<dim>> boxes;
    unsigned int                  begin = 0;
    for (const unsigned int end : ends)
      if (begin < end)
        {
          std::vector<Point<dim>> points;
          for (; begin < end; ++begin)
            append(begin, points);
          boxes.emplace_back(points);
        }
    return boxes;
  }
} // namespace treacle

#endif
