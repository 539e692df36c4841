// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ask.h>
#include <treacle/mesh/covering_boxes.h>
#include <treacle/mesh/tree_locator.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    template <int dim>
    void
    append_corners(const Mesh<dim> &mesh, const LocalIndex cell, std::vector<Point<dim>> &x)
    {
      for (const LocalIndex node : mesh.cell_nodes[cell])
        x.push_back(mesh.node_position[node]);
    }

    template <int dim>
    std::vector<BoundingBox<dim>>
    boxes_of_cells(const Mesh<dim> &mesh)
    {
      std::vector<BoundingBox<dim>> boxes;
      std::vector<Point<dim>>       x;
      for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
        {
          x.clear();
          append_corners(mesh, c, x);
          boxes.emplace_back(x);
        }
      return boxes;
    }

    /// In the order of the numbers of their cells.
    template <int dim>
    std::vector<typename CellTree<dim>::WallFacet>
    wall_facets(const Mesh<dim> &mesh)
    {
      std::vector<LocalIndex> order(mesh.n_owned_cells());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
        return mesh.cell_number[a] < mesh.cell_number[b];
      });
      std::vector<typename CellTree<dim>::WallFacet> walls;
      for (const LocalIndex c : order)
        for (const LocalIndex f : mesh.cell_faces[c])
          if (mesh.face_side[f] != Mesh<dim>::no_side)
            {
              walls.push_back({{}, c});
              for (unsigned int k = 0; k < dim; ++k)
                walls.back().x[k] = mesh.node_position[mesh.face_nodes[f][k]];
            }
      return walls;
    }

    template <int dim>
    Point<dim>
    point_from(const double *coordinates)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = coordinates[d];
      return x;
    }

    /// Ends of runs of n things, all as long.
    std::vector<unsigned int>
    even_runs(const unsigned int n)
    {
      constexpr unsigned int    n_runs = 64;
      std::vector<unsigned int> ends;
      for (unsigned int k = 1; k <= n_runs; ++k)
        ends.push_back(static_cast<std::uint64_t>(n) * k / n_runs);
      return ends;
    }

    template <int dim>
    std::vector<BoundingBox<dim>>
    boxes_of_runs(const Mesh<dim> &mesh)
    {
      return covering_boxes<dim>(even_runs(mesh.n_owned_cells()),
                                 [&](const LocalIndex c, std::vector<Point<dim>> &x) {
                                   append_corners(mesh, c, x);
                                 });
    }
  } // namespace

  template <int dim>
  TreeLocator<dim>::TreeLocator(const Mesh<dim> &mesh)
    : Locator<dim>(mesh, boxes_of_runs(mesh))
    , tree(boxes_of_cells(mesh), wall_facets(mesh), this->rank_boxes())
  {}

  template <int dim>
  Location<dim>
  TreeLocator<dim>::in_tree(const Point<dim> &x, const bool owned) const
  {
    // by so much a point on a face may seem to lie outside of both cells
    constexpr double tolerance = 1e-10;
    tree.cells_around(x, candidates);
    Location<dim> best;
    bool          touches_owned = false;
    for (const LocalIndex c : candidates)
      {
        if (owned && c >= mesh.n_owned_cells())
          continue;
        const Location<dim> location = this->in_cell(c, x);
        if (location.smallest_coordinate() < -tolerance)
          continue;
        touches_owned = touches_owned || c < mesh.n_owned_cells();
        if (best.cell == invalid || mesh.cell_number[c] < mesh.cell_number[best.cell])
          best = location;
      }
    return touches_owned ? best : Location<dim>();
  }

  template <int dim>
  Location<dim>
  TreeLocator<dim>::on_wall(const typename CellTree<dim>::Nearest &nearest) const
  {
    return nearest.cell == invalid ? Location<dim>() : this->in_cell(nearest.cell, nearest.point);
  }

  template <int dim>
  Location<dim>
  TreeLocator<dim>::locate(const Point<dim> &x) const
  {
    const Location<dim> inside = in_tree(x, false);
    if (inside.cell != invalid)
      return inside.cell < mesh.n_owned_cells() ? inside : Location<dim>();
    const auto                nearest = tree.nearest_on_walls(x);
    std::vector<unsigned int> ranks;
    tree.ranks_around(x, nearest.distance, ranks);
    const bool may_be_elsewhere =
      ranks.size() != 1 || ranks[0] != Utilities::MPI::this_mpi_process(mesh.communicator());
    return may_be_elsewhere ? Location<dim>() : on_wall(nearest);
  }

  template <int dim>
  Location<dim>
  TreeLocator<dim>::locate_here(const Point<dim> &x) const
  {
    const Location<dim> inside = in_tree(x, true);
    return inside.cell != invalid ? inside : on_wall(tree.nearest_on_walls(x));
  }

  template <int dim>
  std::vector<typename TreeLocator<dim>::Owner>
  TreeLocator<dim>::owners(const std::vector<Point<dim>> &x) const
  {
    const unsigned int        rank = Utilities::MPI::this_mpi_process(mesh.communicator());
    std::vector<Owner>        result;
    std::vector<Point<dim>>   asked;
    std::vector<unsigned int> elsewhere;
    for (const Point<dim> &p : x)
      {
        const Location<dim> location = locate(p);
        result.push_back({rank, location.point});
        if (location.cell != invalid)
          continue;
        elsewhere.push_back(result.size() - 1);
        asked.push_back(p);
      }
    const std::vector<Owner> found = owners_elsewhere(asked);
    for (unsigned int k = 0; k < found.size(); ++k)
      result[elsewhere[k]] = found[k];
    return result;
  }

  template <int dim>
  std::vector<typename TreeLocator<dim>::Owner>
  TreeLocator<dim>::owners_elsewhere(const std::vector<Point<dim>> &x) const
  {
    // each rank that may have the cell tells how far it is, its number, and the point
    std::vector<unsigned int> ranks, whom, index;
    std::vector<Point<dim>>   asked;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        tree.ranks_around(x[i], tree.nearest_on_walls(x[i]).distance, ranks);
        for (const unsigned int r : ranks)
          {
            whom.push_back(r);
            index.push_back(i);
            asked.push_back(x[i]);
          }
      }
    constexpr unsigned int    n    = dim + 2;
    const std::vector<double> told = ask(
      mesh.communicator(), whom, asked, n, [&](const Point<dim> &p, double *answer) {
        const Location<dim> location = locate_here(p);
        answer[0] = location.cell == invalid ? std::numeric_limits<double>::infinity() :
                                               location.point.distance(p);
        answer[1] = location.cell == invalid ? 0. : mesh.cell_number[location.cell];
        for (unsigned int d = 0; d < dim; ++d)
          answer[2 + d] = location.point[d];
      });
    std::vector<Owner>  result(x.size());
    std::vector<double> distance(x.size(), std::numeric_limits<double>::infinity()),
      number(x.size());
    for (unsigned int k = 0; k < whom.size(); ++k)
      {
        const unsigned int i      = index[k];
        const double      *answer = &told[k * n];
        const bool is_nearer = answer[0] < distance[i] - tree.tolerance;
        if (!is_nearer && (answer[0] > distance[i] + tree.tolerance || answer[1] >= number[i]))
          continue;
        distance[i] = answer[0];
        number[i]   = answer[1];
        result[i]   = {whom[k], point_from<dim>(answer + 2)};
      }
    return result;
  }

  template <int dim>
  std::vector<Point<dim>>
  TreeLocator<dim>::clamped(const std::vector<Point<dim>> &x) const
  {
    std::vector<Point<dim>> result;
    for (const Owner &owner : owners(x))
      result.push_back(owner.point);
    return result;
  }

  template class TreeLocator<2>;
  template class TreeLocator<3>;
} // namespace treacle
