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
                      const Weight     &weight)
    : comm(comm)
    , prm(parameters)
    , triangulation(
        comm,
        dealii::Triangulation<dim>::none,
        parallel::distributed::Triangulation<dim>::communicate_vertices_to_p4est)
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
    partition(weight);
    collect_leaves();
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
  void
  Octree<dim>::partition(const Weight &weight)
  {
    const auto connection = triangulation.signals.weight.connect(
      [&](const CellIterator &cell, const auto) { return weight(leaf_of(cell)); });
    triangulation.repartition();
    connection.disconnect();
  }

  template <int dim>
  void
  Octree<dim>::collect_leaves()
  {
    // tree and place in it, which order the leaves
    using Entry         = std::pair<std::pair<unsigned int, std::uint64_t>, Leaf<dim>>;
    const auto &tree_of = triangulation.get_coarse_cell_to_p4est_tree_permutation();
    std::vector<Entry> owned, ghosts;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const Leaf<dim>    leaf = leaf_of(cell);
          const unsigned int tree = tree_of[cell->id().get_coarse_cell_id()];
          LatticePoint<dim>  local;
          for (unsigned int d = 0; d < dim; ++d)
            local[d] = leaf.origin[d] % root_size();
          (cell->is_locally_owned() ? owned : ghosts)
            .push_back({{tree, morton<dim>(local)}, leaf});
        }
    n_owned = owned.size();
    all_leaves.clear();
    for (auto *list : {&owned, &ghosts})
      {
        std::sort(list->begin(), list->end(), [](const Entry &a, const Entry &b) {
          return a.first < b.first;
        });
        for (const Entry &entry : *list)
          all_leaves.push_back(entry.second);
      }
    by_origin.reserve(2 * all_leaves.size());
    for (unsigned int i = 0; i < all_leaves.size(); ++i)
      by_origin[pack<dim>(all_leaves[i].origin)] = i;
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
        for (auto &c : corner)
          c &= ~(size - 1);
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
    // the centre of the finest cube: no doubt about points between two leaves
    std::vector<Point<dim>> centres;
    centres.reserve(x.size());
    for (const Point<dim> &p : x)
      {
        LatticePoint<dim> c = finest_cube(p);
        for (auto &i : c)
          ++i;
        centres.push_back(position(c));
      }
    return triangulation.find_point_owner_rank(centres);
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
