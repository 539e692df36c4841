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
    /// Of a box, so that it has a point in it.
    template <int dim>
    void
    extend(Point<dim> &lower, Point<dim> &upper, const Point<dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
    }
  } // namespace

  template <int dim>
  class FacetTree<dim>::Builder
  {
  public:
    Builder(FacetTree &tree, const std::vector<Facet> &facets)
      : facets(facets)
      , origin(tree.origin)
      , extent(tree.extent)
      , nodes(tree.nodes)
      , order(facets.size())
      , sum_of_vertices(facets.size())
    {
      std::iota(order.begin(), order.end(), 0);
      for (unsigned int k = 0; k < facets.size(); ++k)
        for (const Point<dim> &x : facets[k])
          sum_of_vertices[k] += x;
      nodes.reserve(facets.size() / 2 + 1);
    }

    /// The tree of the facets order[begin] to order[end - 1]: the number of its first node.
    unsigned int
    append(const unsigned int begin, const unsigned int end)
    {
      const unsigned int index = nodes.size();
      nodes.push_back({});
      Node                              node{};
      const unsigned int                middle = halved(begin, end);
      const std::array<unsigned int, 5> start  = {{begin, halved(begin, middle), middle, halved(middle, end), end}};
      for (unsigned int part = 0; part < 4; ++part)
        {
          const unsigned int size = start[part + 1] - start[part], k = node.n;
          if (size == 0)
            continue;
          set_disc(node, k, start[part], start[part + 1]);
          node.is_facet[k] = size == 1;
          node.child[k]    = size == 1 ? order[start[part]] : append(start[part], start[part + 1]);
          ++node.n;
        }
      nodes[index] = node;
      return index;
    }

  private:
    /// Where their upper half begins, once they are sorted along the axis on which they extend furthest.
    unsigned int
    halved(const unsigned int begin, const unsigned int end)
    {
      const unsigned int middle = begin + (end - begin) / 2;
      if (begin == middle)
        return middle;
      Point<dim> lower = sum_of_vertices[order[begin]], upper = lower;
      for (unsigned int i = begin; i < end; ++i)
        extend(lower, upper, sum_of_vertices[order[i]]);
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (upper[d] - lower[d] > upper[axis] - lower[axis])
          axis = d;
      std::nth_element(order.begin() + begin,
                       order.begin() + middle,
                       order.begin() + end,
                       [&](const unsigned int a, const unsigned int b) {
                         return sum_of_vertices[a][axis] < sum_of_vertices[b][axis];
                       });
      return middle;
    }

    /// The disc @p k of a node.
    void
    set_disc(Node &node, const unsigned int k, const unsigned int begin, const unsigned int end) const
    {
      Point<dim>     lower = facets[order[begin]][0], upper = lower;
      Tensor<1, dim> normal;
      for (unsigned int i = begin; i < end; ++i)
        {
          normal += area_vector<dim>(facets[order[i]]);
          for (const Point<dim> &x : facets[order[i]])
            extend(lower, upper, x);
        }
      const Point<dim> centre = lower + 0.5 * (upper - lower);
      if (const double norm = normal.norm(); norm > 0)
        normal /= norm;
      double half_thickness = 0, squared_radius = 0;
      for (unsigned int i = begin; i < end; ++i)
        for (const Point<dim> &x : facets[order[i]])
          {
            const Tensor<1, dim> w     = x - centre;
            const double         along = w * normal;
            half_thickness             = std::max(half_thickness, std::abs(along));
            squared_radius             = std::max(squared_radius, w * w - along * along);
          }
      for (unsigned int d = 0; d < dim; ++d)
        {
          node.centre[d][k] = (centre[d] - origin[d]) / extent;
          node.normal[d][k] = normal[d];
        }
      node.radius[k]         = std::sqrt(squared_radius) / extent;
      node.half_thickness[k] = half_thickness / extent;
    }

    const std::vector<Facet> &facets;
    const Point<dim>          origin;
    const double              extent;
    std::vector<Node>        &nodes;
    std::vector<unsigned int> order; ///< of the facets
    std::vector<Point<dim>>   sum_of_vertices;
  };

  template <int dim>
  FacetTree<dim>::FacetTree(const std::vector<Facet> &facets)
  {
    if (facets.empty())
      return;
    Point<dim> lower = facets[0][0], upper = lower;
    for (const Facet &facet : facets)
      for (const Point<dim> &x : facet)
        extend(lower, upper, x);
    origin = lower + 0.5 * (upper - lower);
    extent = 0;
    for (unsigned int d = 0; d < dim; ++d)
      extent = std::max(extent, upper[d] - origin[d]);
    if (extent == 0) // all in a point
      extent = 1;
    Builder(*this, facets).append(0, facets.size());
  }

  template class FacetTree<2>;
  template class FacetTree<3>;
} // namespace treacle
