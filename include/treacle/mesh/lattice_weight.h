// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_lattice_weight_h
#define treacle_mesh_lattice_weight_h

#include <treacle/mesh/octree.h>

namespace treacle
{
  /// Weights, in units of the squared half edge of a leaf, that make the
  /// lattice weighted Delaunay with the longest possible dual edges.
  template <int dim>
  struct LatticeWeights
  {
    static constexpr double centre     = dim == 2 ? 0.343 : 0;
    static constexpr double hanging    = dim == 2 ? -0.071 : -0.18469;
    static constexpr double box_centre = dim == 2 ? 0 : -1;
  };

  /// Weight (m^2) of a vertex of a cell that stands on an owned leaf.
  template <int dim>
  double
  lattice_weight(const Octree<dim> &octree, const LatticePoint<dim> &vertex);
} // namespace treacle

#endif
