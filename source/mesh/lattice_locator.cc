// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/lattice_locator.h>

namespace treacle
{
  template <int dim>
  void
  LatticeLocator<dim>::find_candidates(const Point<dim> &x, const LocalIndex l) const
  {
    const Octree<dim>   &octree = lattice->octree();
    const Leaf<dim>     &leaf   = octree.leaves()[l];
    const Tensor<1, dim> r      = x - octree.position(leaf.centre());
    unsigned int         axis   = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(r[d]) > std::abs(r[axis]))
        axis = d;
    const bool upper = r[axis] > 0;
    lattice->cells_over(l, 2 * axis + upper, candidates);
    if (!candidates.empty())
      return;
    Leaf<dim> lower = leaf; // the equal leaf below has filled this face
    lower.origin[axis] -= leaf.size;
    lattice->cells_over(lower, 2 * axis + 1, candidates);
  }

  template <int dim>
  Location<dim>
  LatticeLocator<dim>::locate(const Point<dim> &x_in) const
  {
    if (!std::isfinite(x_in.norm_square()))
      return {};
    const Point<dim>   x      = this->moved_to_box(x_in);
    const Octree<dim> &octree = lattice->octree();
    const LocalIndex   leaf   = octree.leaf_containing(x);
    if (leaf == invalid || leaf >= octree.n_owned_leaves())
      return {};
    find_candidates(x, leaf);

    Location<dim> best;
    double        largest = -std::numeric_limits<double>::max();
    for (const LocalIndex c : candidates)
      {
        const Location<dim> location = this->in_cell(c, x);
        const double        smallest = location.smallest_coordinate();
        if (smallest > largest)
          {
            largest = smallest;
            best    = location;
          }
        if (smallest >= 0)
          break;
      }
    Assert(largest > -1e-5, ExcMessage("No cell of its leaf contains the point."));
    return best;
  }

  template <int dim>
  std::vector<typename LatticeLocator<dim>::Owner>
  LatticeLocator<dim>::owners(const std::vector<Point<dim>> &x) const
  {
    std::vector<Point<dim>> moved;
    moved.reserve(x.size());
    for (const Point<dim> &p : x)
      moved.push_back(this->moved_to_box(p));
    const std::vector<unsigned int> ranks = lattice->octree().owner_ranks(moved);
    std::vector<Owner>              result;
    result.reserve(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      result.push_back({ranks[i], moved[i]});
    return result;
  }

  template <int dim>
  std::vector<Point<dim>>
  LatticeLocator<dim>::clamped(const std::vector<Point<dim>> &x) const
  {
    std::vector<Point<dim>> result;
    result.reserve(x.size());
    for (const Point<dim> &p : x)
      result.push_back(this->moved_to_box(p));
    return result;
  }

  template class LatticeLocator<2>;
  template class LatticeLocator<3>;
} // namespace treacle
