// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/facet_tree.h>

#include <algorithm>
#include <numeric>

namespace treacle
{
  namespace
  {
    constexpr unsigned int facets_in_leaf = 4;
  } // namespace

  template <int dim>
  FacetTree<dim>::FacetTree(const std::vector<Facet> &facets)
    : order(facets.size())
  {
    std::iota(order.begin(), order.end(), 0);
    nodes.reserve(facets.size());
    if (!facets.empty())
      build(facets, 0, facets.size());
  }

  template <int dim>
  void
  FacetTree<dim>::build(const std::vector<Facet> &facets,
                        const unsigned int        begin,
                        const unsigned int        end)
  {
    Node node{facets[order[begin]][0], facets[order[begin]][0], begin, end, 0};
    for (unsigned int k = begin; k < end; ++k)
      for (const Point<dim> &x : facets[order[k]])
        for (unsigned int d = 0; d < dim; ++d)
          {
            node.lower[d] = std::min(node.lower[d], x[d]);
            node.upper[d] = std::max(node.upper[d], x[d]);
          }
    const unsigned int index = nodes.size();
    nodes.push_back(node);
    if (end - begin <= facets_in_leaf)
      return;

    unsigned int axis = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (node.upper[d] - node.lower[d] > node.upper[axis] - node.lower[axis])
        axis = d;
    const auto place = [&](const unsigned int facet) {
      double sum = 0;
      for (const Point<dim> &x : facets[facet])
        sum += x[axis];
      return sum;
    };
    const unsigned int middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin,
                     order.begin() + middle,
                     order.begin() + end,
                     [&](const unsigned int a, const unsigned int b) {
                       return place(a) < place(b);
                     });
    nodes[index].end = begin;
    build(facets, begin, middle);
    nodes[index].second = nodes.size();
    build(facets, middle, end);
  }

  template class FacetTree<2>;
  template class FacetTree<3>;
} // namespace treacle
