// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/tree_order.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

namespace treacle
{
  template <int dim>
  TreeOrder<dim>::TreeOrder(const LatticePoint<dim> &n)
    : n(n)
  {
    LatticePoint<dim> last;
    for (unsigned int d = 0; d < dim; ++d)
      last[d] = n[d] - 1;
    const unsigned int     n_trees = index(last) + 1;
    DynamicSparsityPattern touching(n_trees, n_trees);
    const auto             root_at = [&](unsigned int i) {
      LatticePoint<dim> root;
      for (unsigned int d = 0; d < dim; i /= n[d++])
        root[d] = i % n[d];
      return root;
    };
    const unsigned int n_around = dim == 2 ? 9 : 27;
    for (unsigned int i = 0; i < n_trees; ++i)
      for (unsigned int k = 0, offset = 0; k < n_around; offset = ++k)
        {
          LatticePoint<dim> other     = root_at(i);
          bool              is_inside = true;
          for (unsigned int d = 0; d < dim; ++d, offset /= 3)
            {
              other[d] += static_cast<int>(offset % 3) - 1;
              is_inside = is_inside && other[d] >= 0 && other[d] < n[d];
            }
          if (is_inside)
            touching.add(i, index(other));
        }
    std::vector<DynamicSparsityPattern::size_type> places(n_trees);
    SparsityTools::reorder_hierarchical(touching, places);
    trees.assign(places.begin(), places.end());
    roots.resize(n_trees);
    for (unsigned int i = 0; i < n_trees; ++i)
      roots[trees[i]] = root_at(i);
  }

  template <int dim>
  unsigned int
  TreeOrder<dim>::index(const LatticePoint<dim> &root) const
  {
    unsigned int i = 0;
    for (int d = dim - 1; d >= 0; --d)
      i = i * n[d] + root[d];
    return i;
  }

  template <int dim>
  unsigned int
  TreeOrder<dim>::tree(const LatticePoint<dim> &root) const
  {
    return trees[index(root)];
  }

  template class TreeOrder<2>;
  template class TreeOrder<3>;
} // namespace treacle
