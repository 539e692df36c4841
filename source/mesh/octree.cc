// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/octree.h>

#include <deal.II/grid/grid_generator.h>

namespace treacle
{
  namespace
  {
    /// Position along the Morton curve of one tree (x is the lowest bit).
    template <int dim>
    std::uint64_t
    morton(const LatticePoint<dim> &p)
    {
      std::uint64_t code = 0;
      for (unsigned int bit = 0; bit < 21; ++bit)
        for (unsigned int d = 0; d < dim; ++d)
          code |= static_cast<std::uint64_t>((p[d] >> bit) & 1) << (dim * bit + d);
      return code;
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
    , triangulation(comm)
    , factor(size_factor)
  {
    const std::vector<unsigned int> n = prm.root_counts();
    unit                              = 0.5 * prm.finest_size();
    prm.check();
    for (unsigned int d = 0; d < dim; ++d)
      box[d] = static_cast<int>(n[d]) * root_size();
    GridGenerator::subdivided_hyper_rectangle(triangulation,
                                              n,
                                              prm.lower_corner,
                                              prm.upper_corner);
    refine(criterion);
    collect_leaves(partition(weight));
    find_ranges();
  }

  template <int dim>
  Leaf<dim>
  Octree<dim>::leaf_of(const CellIterator &cell) const
  {
    const unsigned int level = cell->level();
    return {finest_cube(cell->vertex(0)), root_size() >> level, level};
  }

  template <int dim>
  void
  Octree<dim>::refine(const Criterion &criterion)
  {
    for (unsigned int level = 0;
         level < std::min(prm.surface_level, triangulation.n_global_levels());
         ++level)
      {
        std::vector<Leaf<dim>>    leaves;
        std::vector<CellIterator> cells;
        for (const auto &cell : triangulation.active_cell_iterators_on_level(level))
          if (cell->is_locally_owned())
            {
              cells.push_back(cell);
              leaves.push_back(leaf_of(cell));
            }
        const std::vector<bool> is_to_refine = criterion(leaves);
        for (unsigned int i = 0; i < cells.size(); ++i)
          if (is_to_refine[i])
            cells[i]->set_refine_flag();
        triangulation.execute_coarsening_and_refinement();
      }
  }

  template <int dim>
  std::unordered_map<VertexKey, unsigned int>
  Octree<dim>::partition(const Weight &weight)
  {
    std::vector<Leaf<dim>> leaves;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        leaves.push_back(leaf_of(cell));
    const std::vector<unsigned int>             values = weight(leaves);
    std::unordered_map<VertexKey, unsigned int> weight_at;
    for (unsigned int i = 0; i < leaves.size(); ++i)
      weight_at[pack<dim>(leaves[i].origin)] = values[i];
    const auto weight_of = [&](const CellIterator &cell, const auto) {
      return weight_at.at(pack<dim>(leaf_of(cell).origin));
    };

    // weights move with their leaves
    const auto         connection = triangulation.signals.weight.connect(weight_of);
    const unsigned int handle     = triangulation.register_data_attach(
      [&](const CellIterator &cell, const auto status) {
        return Utilities::pack(weight_of(cell, status), false);
      },
      false);
    triangulation.repartition();
    connection.disconnect();
    std::unordered_map<VertexKey, unsigned int> now;
    triangulation.notify_ready_to_unpack(
      handle, [&](const CellIterator &cell, const auto, const auto &data) {
        now[pack<dim>(leaf_of(cell).origin)] =
          Utilities::unpack<unsigned int>(data.begin(), data.end(), false);
      });
    return now;
  }

  template <int dim>
  void
  Octree<dim>::collect_leaves(const std::unordered_map<VertexKey, unsigned int> &weight_at)
  {
    using Entry = std::pair<Position, Leaf<dim>>;
    std::vector<Entry> owned, ghosts;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const Leaf<dim> leaf = leaf_of(cell);
          (cell->is_locally_owned() ? owned : ghosts)
            .push_back({position_on_curve(leaf.origin), leaf});
        }
    for (auto *list : {&owned, &ghosts})
      {
        std::sort(list->begin(), list->end(), [](const Entry &a, const Entry &b) {
          return a.first < b.first;
        });
        for (const Entry &entry : *list)
          all_leaves.push_back(entry.second);
      }
    for (unsigned int i = 0; i < owned.size(); ++i)
      weights.push_back(weight_at.at(pack<dim>(all_leaves[i].origin)));
    by_origin.reserve(2 * all_leaves.size());
    for (unsigned int i = 0; i < all_leaves.size(); ++i)
      by_origin[pack<dim>(all_leaves[i].origin)] = i;
  }

  template <int dim>
  typename Octree<dim>::Position
  Octree<dim>::position_on_curve(const LatticePoint<dim> &cube) const
  {
    // root cells are numbered along x first
    LatticePoint<dim> local;
    unsigned int      root = 0;
    for (int d = dim - 1; d >= 0; --d)
      {
        root     = root * (box[d] / root_size()) + cube[d] / root_size();
        local[d] = cube[d] % root_size();
      }
    return {triangulation.get_coarse_cell_to_p4est_tree_permutation()[root], morton<dim>(local)};
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
