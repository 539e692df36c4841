// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_coordinates_h
#define treacle_io_coordinates_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Are leaves so far from the origin that a float of their coordinates (m) is a thousandth of a leaf off?
  template <int dim>
  bool
  need_doubles(const Mesh<dim> &mesh)
  {
    const auto &[lower, upper] = mesh.box().get_boundary_points();
    double farthest            = 0;
    for (unsigned int d = 0; d < dim; ++d)
      farthest = std::max({farthest, std::abs(lower[d]), std::abs(upper[d])});
    return std::numeric_limits<float>::epsilon() * farthest > 1e-3 * mesh.finest_size();
  }

  /// Call @p visit with the coordinates as they are written: in doubles or in floats.
  template <typename Coordinates, typename Visit>
  auto
  as_written(const Coordinates &x, const bool in_doubles, const Visit &visit)
  {
    return in_doubles ? visit(std::vector<double>(x.begin(), x.end())) : visit(std::vector<float>(x.begin(), x.end()));
  }
} // namespace treacle

#endif
