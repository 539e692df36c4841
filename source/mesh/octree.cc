// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/mesh/octree.h>

#include <deal.II/grid/grid_generator.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    double
    shortest_edge(const typename Octree<dim>::Parameters &prm)
    {
      const Tensor<1, dim> edge     = prm.upper_corner - prm.lower_corner;
      double               shortest = edge[0];
      for (unsigned int d = 1; d < dim; ++d)
        shortest = std::min(shortest, edge[d]);
      return shortest;
    }

    /// Root cubes along each axis.
    template <int dim>
    std::vector<unsigned int>
    root_counts(const typename Octree<dim>::Parameters &prm)
    {
      const double shortest = shortest_edge<dim>(prm);
      const double              s = shortest / prm.root_cells;
      std::vector<unsigned int> n(dim);
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double edge = prm.upper_corner[d] - prm.lower_corner[d];
          n[d]              = static_cast<unsigned int>(std::lround(edge / s));
          require(std::abs(edge / s - n[d]) < 1e-6,
                  "Domain: cubes cannot tile the box. With Mesh/Root cells = " +
                    std::to_string(prm.root_cells) + " a root cube has the edge " +
                    digits(s) + " m, and edge " + std::to_string(d + 1) +
                    " of the box is " + digits(edge / s) +
                    " cubes long. Change the corners, or raise Root cells until every "
                    "edge is a whole number of cubes.");
        }
      return n;
    }

    /// Position along the Morton curve of one tree (x is the lowest bit).
    template <int dim>
    std::uint64_t
    morton(const LatticePoint<dim> &p)
    {
      std::uint64_t code = 0;
      for (unsigned int bit = 0; bit < 21; ++bit)
        for (unsigned int d = 0; d < dim; ++d)
          code |= static_cast<std::uint64_t>((p[d] >> bit) & 1)
                  << (dim * bit + d);
      return code;
    }
  } // namespace

  template <int dim>
  void
  Octree<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    prm.add_parameter("Root cells",
                      root_cells,
                      "Cubes along the shortest edge of the box at level 0.",
                      Patterns::Integer(1, 1000));
    prm.add_parameter("Surface level",
                      surface_level,
                      "Level of the leaves in a band around the surface; a leaf "
                      "of level l has the edge: shortest box edge / (Root cells "
                      "* 2^l).",
                      Patterns::Integer(1, 18));
    prm.add_parameter("Interior level",
                      interior_level,
                      "Smallest level of leaves inside the liquid.",
                      Patterns::Integer(0, 18));
    prm.add_parameter("Air level",
                      air_level,
                      "Smallest level of leaves anywhere.",
                      Patterns::Integer(0, 18));
    prm.add_parameter("Band width",
                      band_width,
                      "Number of finest leaves on each side of the surface.",
                      Patterns::Integer(1, 20));
    prm.leave_subsection();
  }

  template <int dim>
  void
  Octree<dim>::Parameters::check() const
  {
    for (const unsigned int n : root_counts<dim>(*this))
      require(static_cast<double>(n) * (2 << surface_level) < (1 << 21),
              "Mesh/Surface level and Mesh/Root cells: more than 2^20 leaves along an edge "
              "of the box; lower one of them.");
    require(interior_level <= surface_level && air_level <= surface_level,
            "Mesh/Interior level and Mesh/Air level must not be larger than Mesh/Surface "
            "level.");
  }

  template <int dim>
  double
  Octree<dim>::Parameters::finest_size() const
  {
    return std::ldexp(shortest_edge<dim>(*this) / root_cells, -static_cast<int>(surface_level));
  }

  template <int dim>
  Octree<dim>::Octree(
    const MPI_Comm                                       &comm,
    const Parameters                                     &parameters,
    const Criterion                                      &criterion,
    const std::function<unsigned int(const Leaf<dim> &)> &weight)
    : comm(comm)
    , prm(parameters)
    , triangulation(comm,
                    dealii::Triangulation<dim>::none,
                    parallel::distributed::Triangulation<
                      dim>::communicate_vertices_to_p4est)
  {
    const std::vector<unsigned int> n        = root_counts<dim>(prm);
    const int                       root     = 2 << prm.surface_level;
    unit                                     = 0.5 * prm.finest_size();
    prm.check();
    for (unsigned int d = 0; d < dim; ++d)
      box[d] = static_cast<int>(n[d]) * root;
    GridGenerator::subdivided_hyper_rectangle(triangulation,
                                              n,
                                              prm.lower_corner,
                                              prm.upper_corner);

    for (unsigned int level = 0;
         level < std::min(prm.surface_level, triangulation.n_global_levels());
         ++level)
      {
        std::vector<Leaf<dim>>                                         leaves;
        std::vector<typename Triangulation<dim>::active_cell_iterator> cells;
        for (const auto &cell :
             triangulation.active_cell_iterators_on_level(level))
          if (cell->is_locally_owned())
            {
              cells.push_back(cell);
              leaves.push_back({finest_cube(cell->vertex(0)),
                                root >> level,
                                level});
            }
        const std::vector<bool> refine = criterion(leaves);
        for (unsigned int i = 0; i < cells.size(); ++i)
          if (refine[i])
            cells[i]->set_refine_flag();
        triangulation.execute_coarsening_and_refinement();
      }

    const auto connection = triangulation.signals.weight.connect(
      [&](const typename Triangulation<dim>::cell_iterator &cell, const auto) {
        const unsigned int level = cell->level();
        return weight(
          {finest_cube(cell->vertex(0)), root >> level, level});
      });
    triangulation.repartition();
    connection.disconnect();
    collect_leaves();
  }

  template <int dim>
  void
  Octree<dim>::collect_leaves()
  {
    struct Entry
    {
      unsigned int  tree;
      std::uint64_t code;
      Leaf<dim>     leaf;
    };
    const auto &tree_of = triangulation.get_coarse_cell_to_p4est_tree_permutation();
    const int   root    = 2 << prm.surface_level;
    std::vector<Entry> owned, ghosts;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const unsigned int level = cell->level();
          const Leaf<dim>    leaf{finest_cube(cell->vertex(0)),
                               root >> level,
                               level};
          LatticePoint<dim>  local;
          for (unsigned int d = 0; d < dim; ++d)
            local[d] = leaf.origin[d] % root;
          (cell->is_locally_owned() ? owned : ghosts)
            .push_back({static_cast<unsigned int>(
                          tree_of[cell->id().get_coarse_cell_id()]),
                        morton<dim>(local),
                        leaf});
        }
    n_owned = owned.size();
    all_leaves.clear();
    for (auto *list : {&owned, &ghosts})
      {
        std::sort(list->begin(), list->end(), [](const Entry &a, const Entry &b) {
          return std::tie(a.tree, a.code) < std::tie(b.tree, b.code);
        });
        for (const Entry &e : *list)
          all_leaves.push_back(e.leaf);
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
    for (int size = 2; size <= (2 << prm.surface_level); size *= 2)
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
        const double i =
          std::floor((x[d] - prm.lower_corner[d]) / (2 * unit) + 1e-6);
        c[d] = 2 * static_cast<int>(std::min(std::max(i, 0.), box[d] / 2 - 1.));
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
