// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_tree_order_h
#define treacle_mesh_tree_order_h

#include <treacle/mesh/leaf.h>

#include <vector>

namespace treacle
{
  /// Root cubes of a brick in the order of p4est's trees: neighbours are near one another in it, and
  /// so on the space filling curve that goes through all trees. (deal.II numbers the coarse cells of its distributed triangulations
  /// this way.)
  template <int dim>
  class TreeOrder
  {
  public:
    /// @p n root cubes along each axis.
    explicit TreeOrder(const LatticePoint<dim> &n);

    /// Which tree the root cube at @p root is, which counts root cubes along each axis.
    unsigned int
    tree(const LatticePoint<dim> &root) const;

    LatticePoint<dim>
    root(const unsigned int tree) const
    {
      return roots[tree];
    }

    unsigned int
    n_trees() const
    {
      return trees.size();
    }

    const LatticePoint<dim> n;

  private:
    unsigned int
    index(const LatticePoint<dim> &root) const;

    std::vector<unsigned int>      trees;
    std::vector<LatticePoint<dim>> roots;
  };
} // namespace treacle

#endif
