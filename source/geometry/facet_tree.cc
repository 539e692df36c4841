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
          set_box(node, k, start[part], start[part + 1]);
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

    /// The box @p k of a node.
    void
    set_box(Node &node, const unsigned int k, const unsigned int begin, const unsigned int end) const
    {
      const Tensor<2, dim> axes   = axes_of(begin, end);
      const Point<dim>    &x0     = facets[order[begin]][0];
      Tensor<1, dim>       lower, upper; // along the axes, from x0
      for (unsigned int i = begin; i < end; ++i)
        for (const Point<dim> &x : facets[order[i]])
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double along = axes[d] * (x - x0);
              lower[d]           = std::min(lower[d], along);
              upper[d]           = std::max(upper[d], along);
            }
      const Tensor<1, dim> centre = (x0 - origin) + 0.5 * (lower + upper) * axes;
      for (unsigned int d = 0; d < dim; ++d)
        {
          node.centre[d][k]     = centre[d] / extent;
          node.normal[d][k]     = axes[0][d];
          node.tangent[d][k]    = axes[1][d];
          node.half_width[d][k] = 0.5 * (upper[d] - lower[d]) / extent;
        }
    }

    /// The mean normal of facets, and in 3D the direction across it to their vertex that is furthest from the middle.
    Tensor<2, dim>
    axes_of(const unsigned int begin, const unsigned int end) const
    {
      Tensor<1, dim> normal, middle;
      for (unsigned int i = begin; i < end; ++i)
        {
          normal += area_vector<dim>(facets[order[i]]);
          middle += sum_of_vertices[order[i]] / (dim * double(end - begin));
        }
      const double norm = normal.norm();
      if (!(norm > 0))
        return Tensor<2, dim>(unit_symmetric_tensor<dim>());
      normal /= norm;
      Tensor<2, dim> axes;
      axes[0] = normal;
      if constexpr (dim == 2)
        axes[1] = -cross_product_2d(normal);
      else
        {
          axes[1] = unit_across(normal, begin, end, middle);
          axes[2] = cross_product_3d(axes[0], axes[1]);
        }
      return axes;
    }

    /// Towards the vertex of facets that is furthest across from a point; any direction across it where all of them are on the normal.
    Tensor<1, dim>
    unit_across(const Tensor<1, dim> &normal, const unsigned int begin, const unsigned int end, const Tensor<1, dim> &from) const
    {
      const auto     across = [&](const Tensor<1, dim> &w) { return w - (w * normal) * normal; };
      Tensor<1, dim> furthest;
      for (unsigned int i = begin; i < end; ++i)
        for (const Point<dim> &x : facets[order[i]])
          if (const Tensor<1, dim> w = across(x - from); w.norm_square() > furthest.norm_square())
            furthest = w;
      if (const double norm = furthest.norm(); norm > 0)
        if (const Tensor<1, dim> unit = across(furthest / norm); unit.norm() > 0.5) // not what rounding left
          return unit / unit.norm();
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) < std::abs(normal[axis]))
          axis = d;
      const Tensor<1, dim> any = across(Point<dim>::unit_vector(axis));
      return any / any.norm();
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
