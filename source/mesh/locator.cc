// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/locator.h>

namespace treacle
{
  template <int dim>
  Point<dim>
  Locator<dim>::clamped(Point<dim> x) const
  {
    const auto &box = mesh.octree().parameters();
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = std::min(std::max(x[d], box.lower_corner[d]), box.upper_corner[d]);
    return x;
  }

  template <int dim>
  Location<dim>
  Locator<dim>::locate(const Point<dim> &x_in) const
  {
    const Point<dim>   x      = clamped(x_in);
    const Octree<dim> &octree = mesh.octree();
    const LocalIndex   l      = octree.leaf_containing(x);
    if (l == invalid || l >= octree.n_owned_leaves())
      return {};

    const Leaf<dim>     &leaf = octree.leaves()[l];
    const Tensor<1, dim> r    = x - octree.position(leaf.centre());
    unsigned int         axis = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(r[d]) > std::abs(r[axis]))
        axis = d;
    const bool upper = r[axis] > 0;
    mesh.cells_over(leaf, 2 * axis + upper, candidates);
    if (candidates.empty()) // the equal leaf below has filled this face
      {
        Leaf<dim> lower = leaf;
        lower.origin[axis] -= leaf.size;
        mesh.cells_over(lower, 2 * axis + 1, candidates);
      }

    Location<dim> best;
    double        largest = -std::numeric_limits<double>::max();
    for (const LocalIndex c : candidates)
      {
        const Simplex<dim> vertices = mesh.cell_vertices(c);
        VertexValues<dim>  lambda;
        double             smallest = 1;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            lambda[i] = (i == 0 ? 1. : 0.) + mesh.cell_gradients[c][i] * (x - vertices[0]);
            smallest  = std::min(smallest, lambda[i]);
          }
        if (smallest > largest)
          {
            largest = smallest;
            best    = {c, lambda};
          }
        if (smallest >= 0)
          break;
      }
    Assert(largest > -1e-5, ExcMessage("No cell of its leaf contains the point."));
    return best;
  }

  template class Locator<2>;
  template class Locator<3>;
} // namespace treacle
