// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_tree_order_h
#define treacle_mesh_tree_order_h

#include <treacle/mesh/leaf.h>

#include <vector>

namespace treacle
{
  /// Which of p4est's axes an axis of the box is. The space filling curve goes up and down fastest, along the last one, which is gravity's
  /// mostly: ranks, parts of the curve, stand side by side, and each has its share of the bottom, of the bulk and of the surface.
  template <int dim>
  constexpr unsigned int
  axis_on_curve(const unsigned int d)
  {
    return dim - 1 - d;
  }

  /// The place of a cube along the curve, among cubes of its size.
  template <int dim>
  std::uint64_t
  morton(const LatticePoint<dim> &p);

  /// Root cubes of a brick in the order of p4est's trees, column by column. (In a single column ranks stand on top of one another: p4est's
  /// curve goes through one tree after another.)
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
