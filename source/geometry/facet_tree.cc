// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/facet_tree.h>
#include <treacle/geometry/simplex.h>

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
    std::vector<Point<dim>> sum_of_vertices(facets.size());
    for (unsigned int k = 0; k < facets.size(); ++k)
      for (const Point<dim> &x : facets[k])
        sum_of_vertices[k] += x;
    if (!facets.empty())
      build(facets, sum_of_vertices, 0, facets.size());
  }

  template <int dim>
  std::pair<typename FacetTree<dim>::Node, unsigned int>
  FacetTree<dim>::around(const std::vector<Facet> &facets,
                         const unsigned int        begin,
                         const unsigned int        end) const
  {
    Point<dim>     lower = facets[order[begin]][0], upper = lower;
    Tensor<1, dim> area;
    for (unsigned int k = begin; k < end; ++k)
      {
        area += area_vector<dim>(facets[order[k]]);
        for (const Point<dim> &x : facets[order[k]])
          for (unsigned int d = 0; d < dim; ++d)
            {
              lower[d] = std::min(lower[d], x[d]);
              upper[d] = std::max(upper[d], x[d]);
            }
      }
    Node node{lower + 0.5 * (upper - lower), area, 0, 0, begin, end, 0};
    if (const double norm = area.norm(); norm > 0)
      node.normal /= norm;
    double squared_radius = 0;
    for (unsigned int k = begin; k < end; ++k)
      for (const Point<dim> &x : facets[order[k]])
        {
          const Tensor<1, dim> w     = x - node.centre;
          const double         along = w * node.normal;
          node.half_thickness        = std::max(node.half_thickness, std::abs(along));
          squared_radius             = std::max(squared_radius, w * w - along * along);
        }
    node.radius       = std::sqrt(squared_radius);
    unsigned int axis = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (upper[d] - lower[d] > upper[axis] - lower[axis])
        axis = d;
    return {node, axis};
  }

  template <int dim>
  void
  FacetTree<dim>::build(const std::vector<Facet>      &facets,
                        const std::vector<Point<dim>> &sum_of_vertices,
                        const unsigned int             begin,
                        const unsigned int             end)
  {
    const auto [node, axis]  = around(facets, begin, end);
    const unsigned int index = nodes.size();
    nodes.push_back(node);
    if (end - begin <= facets_in_leaf)
      return;

    const unsigned int middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin,
                     order.begin() + middle,
                     order.begin() + end,
                     [&, axis = axis](const unsigned int a, const unsigned int b) {
                       return sum_of_vertices[a][axis] < sum_of_vertices[b][axis];
                     });
    nodes[index].end = begin;
    build(facets, sum_of_vertices, begin, middle);
    nodes[index].second = nodes.size();
    build(facets, sum_of_vertices, middle, end);
  }

  template class FacetTree<2>;
  template class FacetTree<3>;
} // namespace treacle
