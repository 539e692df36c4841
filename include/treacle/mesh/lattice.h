// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_lattice_h
#define treacle_mesh_lattice_h

#include <treacle/mesh/octree.h>

namespace treacle
{
  /// The simplices that stand on the owned leaves of an octree: a graded
  /// body-centred lattice (after Labelle & Shewchuk 2007). A pure function
  /// of the leaves; a pair of equal leaves is filled by the lower one.
  template <int dim>
  struct Lattice
  {
    using Cell = std::array<LatticePoint<dim>, dim + 1>;

    /// Right-handed, leaf by leaf, face by face.
    std::vector<Cell> cells;

    /// Cells over face f (2 axis + upper) of owned leaf l, that is between
    /// the face and the leaf's centre, and the neighbour's where it is equal:
    /// from start[2 dim l + f] to start[2 dim l + f + 1].
    std::vector<unsigned int> start;
  };

  template <int dim>
  Lattice<dim>
  make_lattice(const Octree<dim> &octree);

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
