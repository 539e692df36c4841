// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/forest.h>
#include <treacle/mesh/octree.h>

namespace treacle
{
  namespace
  {
    /// Along each axis. Throws a UserError where there are none, or too many.
    template <int dim>
    LatticePoint<dim>
    root_cubes(const OctreeParameters<dim> &prm)
    {
      prm.check();
      const std::vector<unsigned int> n = prm.root_counts();
      LatticePoint<dim>               result{};
      std::copy(n.begin(), n.end(), result.begin());
      return result;
    }
  } // namespace

  template <int dim>
  Octree<dim>::Octree(const MPI_Comm   &comm,
                      const Parameters &parameters,
                      const Criterion  &criterion,
                      const Weight     &weight,
                      const double      size_factor)
    : comm(comm)
    , prm(parameters)
    , order(root_cubes(prm))
    , factor(size_factor)
  {
    unit = 0.5 * prm.finest_size();
    for (unsigned int d = 0; d < dim; ++d)
      box[d] = order.n[d] * root_size();
    Forest<dim> forest(comm, order, root_size());
    refine(forest, criterion);
    forest.partition(weight(forest.owned_leaves()));
    collect_leaves(forest);
    find_ranges();
  }

  template <int dim>
  void
  Octree<dim>::refine(Forest<dim> &forest, const Criterion &criterion) const
  {
    bool is_finer = true;
    for (unsigned int level = 0; level < prm.surface_level && is_finer; ++level)
      {
        std::vector<Leaf<dim>>    leaves; // of the level
        std::vector<unsigned int> place;
        const std::vector<Leaf<dim>> owned = forest.owned_leaves();
        for (unsigned int i = 0; i < owned.size(); ++i)
          if (owned[i].level == level)
            {
              leaves.push_back(owned[i]);
              place.push_back(i);
            }
        const std::vector<bool> is_near = criterion(leaves);
        std::vector<bool>       is_to_refine(owned.size(), false);
        for (unsigned int i = 0; i < place.size(); ++i)
          is_to_refine[place[i]] = is_near[i];
        is_finer = forest.refine(is_to_refine);
      }
  }

  template <int dim>
  void
  Octree<dim>::collect_leaves(const Forest<dim> &forest)
  {
    all_leaves = forest.owned_leaves();
    weights    = forest.weights();
    const std::vector<Leaf<dim>> ghosts = forest.ghost_leaves();
    all_leaves.insert(all_leaves.end(), ghosts.begin(), ghosts.end());
    by_origin.reserve(2 * all_leaves.size());
    for (unsigned int i = 0; i < all_leaves.size(); ++i)
      by_origin[pack<dim>(all_leaves[i].origin)] = i;
  }

  template <int dim>
  typename Octree<dim>::Position
  Octree<dim>::position_on_curve(const LatticePoint<dim> &cube) const
  {
    LatticePoint<dim> root, local;
    for (unsigned int d = 0; d < dim; ++d)
      {
        root[d]  = cube[d] / root_size();
        local[d] = cube[d] % root_size();
      }
    return {order.tree(root), morton<dim>(local)};
  }

  template <int dim>
  void
  Octree<dim>::find_ranges()
  {
    constexpr Position end{std::numeric_limits<unsigned int>::max(), 0};
    first_of_rank = Utilities::MPI::all_gather(
      comm, n_owned_leaves() == 0 ? end : position_on_curve(all_leaves.front().origin));
    for (unsigned int rank = first_of_rank.size(); rank-- > 0;)
      if (first_of_rank[rank] == end && rank + 1 < first_of_rank.size())
        first_of_rank[rank] = first_of_rank[rank + 1];
  }

  template <int dim>
  LocalIndex
  Octree<dim>::leaf_at(const LatticePoint<dim> &origin) const
  {
    const auto it = by_origin.find(pack<dim>(origin));
    return it == by_origin.end() ? invalid : it->second;
  }

  template <int dim>
  LocalIndex
  Octree<dim>::leaf_containing(const Point<dim> &x) const
  {
    LatticePoint<dim> corner = finest_cube(x);
    for (int size = 2; size <= root_size(); size *= 2)
      {
        corner                = cube_around<dim>(corner, size);
        const LocalIndex leaf = leaf_at(corner);
        if (leaf != invalid && all_leaves[leaf].size == size)
          return leaf;
      }
    return invalid;
  }

  template <int dim>
  std::vector<unsigned int>
  Octree<dim>::owner_ranks(const std::vector<Point<dim>> &x) const
  {
    std::vector<unsigned int> ranks;
    ranks.reserve(x.size());
    for (const Point<dim> &p : x)
      ranks.push_back(std::upper_bound(first_of_rank.begin(),
                                       first_of_rank.end(),
                                       position_on_curve(finest_cube(p))) -
                      first_of_rank.begin() - 1);
    return ranks;
  }

  template <int dim>
  Point<dim>
  Octree<dim>::position(const LatticePoint<dim> &p) const
  {
    Point<dim> x = prm.lower_corner;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = p[d] == box[d] ? prm.upper_corner[d] : x[d] + unit * p[d];
    return x;
  }

  template <int dim>
  LatticePoint<dim>
  Octree<dim>::finest_cube(const Point<dim> &x) const
  {
    LatticePoint<dim> c;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // a corner of a leaf may be off by rounding: 1e-6 of a leaf is its own
        const double i = std::floor((x[d] - prm.lower_corner[d]) / (2 * unit) + 1e-6);
        c[d]           = 2 * static_cast<int>(std::min(std::max(i, 0.), box[d] / 2 - 1.));
      }
    return c;
  }

  template <int dim>
  Neighbour
  Octree<dim>::neighbour(const Leaf<dim> &leaf, const LatticePoint<dim> &offset) const
  {
    LatticePoint<dim> origin, parent;
    for (unsigned int d = 0; d < dim; ++d)
      {
        origin[d] = leaf.origin[d] + offset[d] * leaf.size;
        if (origin[d] < 0 || origin[d] >= box[d])
          return Neighbour::outside;
        parent[d] = origin[d] & ~(2 * leaf.size - 1);
      }
    LocalIndex found = leaf_at(origin);
    if (found != invalid)
      {
        const int size = all_leaves[found].size;
        return size == leaf.size ? Neighbour::same :
               size < leaf.size  ? Neighbour::finer :
                                   Neighbour::coarser;
      }
    // the lowest child of a finer neighbour may lie beyond the ghost layer
    found = leaf_at(parent);
    return found != invalid && all_leaves[found].size == 2 * leaf.size ?
             Neighbour::coarser :
             Neighbour::finer;
  }

  template class Octree<2>;
  template class Octree<3>;
} // namespace treacle
