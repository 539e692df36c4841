// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_facet_tree_h
#define treacle_geometry_facet_tree_h

#include <treacle/base/types.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace treacle
{
  /// A tree of flat boxes around facets (2D: segments, 3D: triangles), to look at the facets near a point, nearer boxes first. A box
  /// lies along the surface, and along its facets where these are long and narrow, so that from beside it many fewer come into
  /// question than boxes along the axes would; and of Boost's R-tree, which finds the k nearest boxes, it is known only afterwards
  /// how many it takes for the nearest facet.
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
    search(const Point<dim> &x, const double radius, const Visit &visit) const
    {
      if (nodes.empty())
        return;
      constexpr float        rounding = 2e-6; // of single precision, and more
      std::array<float, dim> r;
      for (unsigned int d = 0; d < dim; ++d)
        r[d] = (x[d] - origin[d]) / extent;
      const auto square_of = [&](const double length) -> float {
        return (1 + 10 * rounding) * (length / extent) * (length / extent);
      };
      const float               margin = rounding * farthest(r);
      float                     most   = square_of(radius);
      std::array<Entry, 4 * 16> stack; // three of four wait on each level
      unsigned int              n = 0;
      stack[n++]                  = {0, false, 0};
      while (n > 0)
        {
          const Entry entry = stack[--n];
          if (entry.square > most)
            continue;
          if (entry.is_facet)
            {
              most = square_of(visit(entry.child));
              continue;
            }
          const Node        &node    = nodes[entry.child];
          const Four         squares = squared_distances(node, r, margin);
          const unsigned int first   = n;
          for (unsigned int k = 0; k < node.n; ++k)
            if (squares[k] <= most)
              {
                unsigned int place = n++;
                for (; place > first && stack[place - 1].square < squares[k]; --place)
                  stack[place] = stack[place - 1];
                stack[place] = {node.child[k], node.is_facet[k], squares[k]};
              }
        }
    }

  private:
    using Four = std::array<float, 4>;

    /// Four boxes, each of a facet or of another node with all that is below it; in single precision, for what
    /// counts is how many of them the caches hold. Lengths are in extents.
    struct Node
    {
      std::array<Four, dim>       centre;     ///< from the origin
      std::array<Four, dim>       normal;     ///< the first axis of a box
      std::array<Four, dim>       tangent;    ///< the second; the third is perpendicular to both
      std::array<Four, dim>       half_width; ///< along the axes
      std::array<unsigned int, 4> child;
      std::array<bool, 4>         is_facet;
      unsigned int                n; ///< boxes that there are
    };

    struct Entry
    {
      unsigned int child;
      bool         is_facet;
      float        square; ///< of the distance
    };

    /// What lengths are rounded by: that of a point, and of what all are within.
    static float
    farthest(const std::array<float, dim> &r)
    {
      float result = 1;
      for (const float coordinate : r)
        result = std::max(result, std::abs(coordinate));
      return result;
    }

    /// Of a point @p r from the origin, less what @p rounding may add.
    static Four
    squared_distances(const Node &node, const std::array<float, dim> &r, const float rounding)
    {
      const auto &n = node.normal, &t = node.tangent;
      Four        result{};
      for (unsigned int k = 0; k < 4; ++k) // which the compiler takes at once
        {
          std::array<float, dim> w, along{};
          for (unsigned int d = 0; d < dim; ++d)
            {
              w[d] = r[d] - node.centre[d][k];
              along[0] += w[d] * n[d][k];
              along[1] += w[d] * t[d][k];
            }
          if constexpr (dim == 3)
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int e = (d + 1) % dim, f = (d + 2) % dim;
                along[2] += w[d] * (n[e][k] * t[f][k] - n[f][k] * t[e][k]);
              }
          for (unsigned int d = 0; d < dim; ++d)
            {
              const float beyond = std::abs(along[d]) - node.half_width[d][k] - rounding;
              // twice what is positive of it, without a branch
              const float a = beyond + std::abs(beyond);
              result[k] += 0.25f * a * a;
            }
        }
      return result;
    }

    /// Appends nodes.
    class Builder;

    Point<dim>        origin; ///< the middle of them all
    double            extent; ///< of them all from there, along an axis (m)
    std::vector<Node> nodes;  ///< depth first
  };
} // namespace treacle

#endif
