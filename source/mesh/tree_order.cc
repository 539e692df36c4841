// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/tree_order.h>

#include <algorithm>
#include <utility>

namespace treacle
{
  template <int dim>
  std::uint64_t
  morton(const LatticePoint<dim> &p)
  {
    std::uint64_t code = 0;
    for (unsigned int d = 0; d < dim; ++d)
      for (std::uint64_t bits = p[d]; bits != 0; bits &= bits - 1)
        code |= std::uint64_t(1) << (dim * __builtin_ctzll(bits) + axis_on_curve<dim>(d));
    return code;
  }

  template <int dim>
  TreeOrder<dim>::TreeOrder(const LatticePoint<dim> &n)
    : n(n)
  {
    LatticePoint<dim> last;
    for (unsigned int d = 0; d < dim; ++d)
      last[d] = n[d] - 1;
    trees.resize(index(last) + 1);
    for (unsigned int i = 0; i < trees.size(); ++i)
      {
        LatticePoint<dim> root;
        for (unsigned int d = 0, rest = i; d < dim; rest /= n[d++])
          root[d] = rest % n[d];
        roots.push_back(root);
      }
    const auto place = [](LatticePoint<dim> root) {
      const int height = std::exchange(root[dim - 1], 0);
      return std::make_pair(morton<dim>(root), height);
    };
    std::sort(roots.begin(), roots.end(), [&](const LatticePoint<dim> &a, const LatticePoint<dim> &b) {
      return place(a) < place(b);
    });
    for (unsigned int tree = 0; tree < roots.size(); ++tree)
      trees[index(roots[tree])] = tree;
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

  template std::uint64_t
  morton<2>(const LatticePoint<2> &);
  template std::uint64_t
  morton<3>(const LatticePoint<3> &);
  template class TreeOrder<2>;
  template class TreeOrder<3>;
} // namespace treacle
