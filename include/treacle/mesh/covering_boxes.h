// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_covering_boxes_h
#define treacle_mesh_covering_boxes_h

#include <treacle/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <vector>

namespace treacle
{
  /// Boxes around consecutive runs of n things: a few tight ones say more than one
  /// around all. @p append (i, points) adds the corners of thing i.
  template <int dim, typename Append>
  std::vector<BoundingBox<dim>>
  covering_boxes(const unsigned int n, const Append &append)
  {
    constexpr unsigned int        n_boxes = 64;
    std::vector<BoundingBox<dim>> boxes;
    for (unsigned int k = 0; k < n_boxes; ++k)
      {
        const unsigned int begin = static_cast<std::uint64_t>(n) * k / n_boxes;
        const unsigned int end   = static_cast<std::uint64_t>(n) * (k + 1) / n_boxes;
        if (begin == end)
          continue;
        std::vector<Point<dim>> points;
        for (unsigned int i = begin; i < end; ++i)
          append(i, points);
        boxes.emplace_back(points);
      }
    return boxes;
  }
} // namespace treacle

#endif
