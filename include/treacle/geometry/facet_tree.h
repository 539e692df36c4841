// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_facet_tree_h
#define treacle_geometry_facet_tree_h

#include <treacle/base/types.h>

#include <cmath>
#include <vector>

namespace treacle
{
  /// A binary tree of flat discs around facets (2D: segments, 3D: triangles), to look at the facets
  /// near a point, nearer discs first. A disc lies along the surface, so that from beside it many
  /// fewer come into question than boxes would; and of Boost's R-tree, which finds the k nearest
  /// boxes, it is known only afterwards how many it takes for the nearest facet.
  template <int dim>
  class FacetTree
  {
  public:
    using Facet = std::array<Point<dim>, dim>;

    FacetTree() = default;

    explicit FacetTree(const std::vector<Facet> &facets);

    /// Call @p visit with the number of each facet whose disc may be closer to @p x than a
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
          // without branches: which one is nearer cannot be foreseen
          const std::array<Entry, 2> children = {
            {{entry.node + 1, squared_distance(nodes[entry.node + 1], x)},
             {node.second, squared_distance(nodes[node.second], x)}}};
          const bool far = children[0].squared_distance <= children[1].squared_distance;
          for (const bool k : {far, !far})
            {
              stack[n] = children[k];
              n += children[k].squared_distance <= radius * radius;
            }
        }
    }

  private:
    /// A disc (3D), or a rectangle, with all of its facets in it.
    struct Node
    {
      Point<dim>     centre;
      Tensor<1, dim> normal;
      double         radius, half_thickness; ///< across the normal and along it (m)
      unsigned int   begin, end;             ///< of a leaf in order; else equal
      unsigned int   second;                 ///< child; the first is the next node
    };

    struct Entry
    {
      unsigned int node;
      double       squared_distance;
    };

    static double
    squared_distance(const Node &node, const Point<dim> &x)
    {
      const Tensor<1, dim> w      = x - node.centre;
      const double         along  = std::abs(w * node.normal);
      const double         across = std::sqrt(std::max(0., w * w - along * along));
      const double         above  = std::max(0., along - node.half_thickness);
      const double         beside = std::max(0., across - node.radius);
      return above * above + beside * beside;
    }

    /// The disc around the facets order[begin] to order[end - 1], and the axis along which they
    /// extend furthest.
    std::pair<Node, unsigned int>
    around(const std::vector<Facet> &facets, const unsigned int begin, const unsigned int end) const;

    /// Append the tree of the facets order[begin] to order[end - 1].
    void
    build(const std::vector<Facet>      &facets,
          const std::vector<Point<dim>> &sum_of_vertices,
          const unsigned int             begin,
          const unsigned int             end);

    std::vector<Node>         nodes; ///< depth first
    std::vector<unsigned int> order; ///< facets, those of a leaf together
  };
} // namespace treacle

#endif
