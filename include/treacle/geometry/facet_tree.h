// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_facet_tree_h
#define treacle_geometry_facet_tree_h

#include <treacle/base/types.h>

#include <vector>

namespace treacle
{
  /// A binary tree of boxes around facets (2D: segments, 3D: triangles), to look at the facets
  /// near a point, nearer boxes first. Boost's R-tree finds the k nearest boxes, but how many
  /// it takes for the nearest facet is known only afterwards: many times the work.
  template <int dim>
  class FacetTree
  {
  public:
    using Facet = std::array<Point<dim>, dim>;

    FacetTree() = default;

    explicit FacetTree(const std::vector<Facet> &facets);

    /// Call @p visit with the number of each facet whose box may be closer to @p x than a
    /// radius (m), which is @p radius first and then what @p visit returned last.
    template <typename Visit>
    void
    search(const Point<dim> &x, double radius, const Visit &visit) const
    {
      if (nodes.empty())
        return;
      std::array<Entry, 64> stack;
      unsigned int          n = 0;
      stack[n++]              = {0, squared_distance(nodes[0], x)};
      while (n > 0)
        {
          const Entry entry = stack[--n];
          if (entry.squared_distance > radius * radius)
            continue;
          const Node &node = nodes[entry.node];
          for (unsigned int k = node.begin; k < node.end; ++k)
            radius = visit(order[k]);
          if (node.begin < node.end)
            continue;
          Entry near = {entry.node + 1, squared_distance(nodes[entry.node + 1], x)};
          Entry far  = {node.second, squared_distance(nodes[node.second], x)};
          if (far.squared_distance < near.squared_distance)
            std::swap(near, far);
          stack[n++] = far;
          stack[n++] = near;
        }
    }

  private:
    struct Node
    {
      Point<dim>   lower, upper;
      unsigned int begin, end; ///< of a leaf in order; else equal
      unsigned int second;     ///< child; the first is the next node
    };

    struct Entry
    {
      unsigned int node;
      double       squared_distance;
    };

    static double
    squared_distance(const Node &node, const Point<dim> &x)
    {
      double sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double outside = std::max({0., node.lower[d] - x[d], x[d] - node.upper[d]});
          sum += outside * outside;
        }
      return sum;
    }

    /// Append the tree of the facets order[begin] to order[end - 1].
    void
    build(const std::vector<Facet> &facets, const unsigned int begin, const unsigned int end);

    std::vector<Node>         nodes; ///< depth first
    std::vector<unsigned int> order; ///< facets, those of a leaf together
  };
} // namespace treacle

#endif
