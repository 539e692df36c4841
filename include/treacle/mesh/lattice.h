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
} // namespace treacle

#endif
