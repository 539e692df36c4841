// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_sowing_h
#define treacle_surface_sowing_h

#include <treacle/base/scattered.h>
#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// A number in [0, 1) for a cell, the same on all ranks: where its even sequence of seeds starts.
  template <int dim>
  double
  start_of_seeds(const Mesh<dim> &mesh, const LocalIndex cell)
  {
    std::uint64_t key = 0;
    for (const LocalIndex node : mesh.cell_nodes[cell])
      key += mesh.node_key[node];
    return scattered(key);
  }

  /// Does a marker or point stay in a cell that has @p n and wants @p target of them? Crowded cells, with
  /// more than twice that, keep a part that depends on places in the box alone.
  template <int dim>
  bool
  stays(const Mesh<dim> &mesh, const Point<dim> &x, const double n, const double target)
  {
    const Point<dim> in_box(x - mesh.box().get_boundary_points().first);
    return n <= 2 * target + 2 || scattered_at(in_box, 1e-3 * mesh.finest_size()) * n < target;
  }
} // namespace treacle

#endif
