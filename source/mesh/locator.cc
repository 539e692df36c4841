// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ask.h>
#include <treacle/mesh/locator.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    double
    smallest_coordinate(const Location<dim> &location)
    {
      return *std::min_element(location.lambda.begin(), location.lambda.end());
    }
  } // namespace

  template <int dim>
  Point<dim>
  Locator<dim>::moved_to_box(Point<dim> x) const
  {
    const BoundingBox<dim> &box = mesh.box();
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = std::min(std::max(x[d], box.lower_bound(d)), box.upper_bound(d));
    return x;
  }

  template <int dim>
  Location<dim>
  Locator<dim>::in_cell(const LocalIndex cell, const Point<dim> &x) const
  {
    const Point<dim> &origin = mesh.node_position[mesh.cell_nodes[cell][0]];
    Location<dim>     result{cell, x, {}};
    for (unsigned int i = 0; i <= dim; ++i)
      result.lambda[i] = (i == 0 ? 1. : 0.) + mesh.cell_gradients[cell][i] * (x - origin);
    return result;
  }

  template <int dim>
  Location<dim>
  Locator<dim>::in_lattice(const Point<dim> &x_in) const
  {
    if (!std::isfinite(x_in.norm_square()))
      return {};
    const Point<dim>   x      = moved_to_box(x_in);
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
    mesh.lattice()->cells_over(leaf, 2 * axis + upper, candidates);
    if (candidates.empty()) // the equal leaf below has filled this face
      {
        Leaf<dim> lower = leaf;
        lower.origin[axis] -= leaf.size;
        mesh.lattice()->cells_over(lower, 2 * axis + 1, candidates);
      }

    Location<dim> best;
    double        largest = -std::numeric_limits<double>::max();
    for (const LocalIndex c : candidates)
      {
        const Location<dim> location = in_cell(c, x);
        const double smallest = smallest_coordinate(location);
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
  Location<dim>
  Locator<dim>::in_tree(const Point<dim> &x, const bool owned) const
  {
    // by so much a point on a face may seem to lie outside of both cells
    constexpr double tolerance = 1e-10;
    mesh.cell_tree()->cells_around(x, candidates);
    Location<dim> best;
    bool          touches_owned = false;
    for (const LocalIndex c : candidates)
      {
        if (owned && c >= mesh.n_owned_cells())
          continue;
        const Location<dim> location = in_cell(c, x);
        if (smallest_coordinate(location) < -tolerance)
          continue;
        touches_owned = touches_owned || c < mesh.n_owned_cells();
        if (best.cell == invalid || mesh.cell_number[c] < mesh.cell_number[best.cell])
          best = location;
      }
    return touches_owned ? best : Location<dim>();
  }

  template <int dim>
  Location<dim>
  Locator<dim>::on_wall(const typename CellTree<dim>::Nearest &nearest) const
  {
    return nearest.cell == invalid ? Location<dim>() : in_cell(nearest.cell, nearest.point);
  }

  template <int dim>
  Location<dim>
  Locator<dim>::locate(const Point<dim> &x) const
  {
    if (mesh.lattice() != nullptr)
      return in_lattice(x);
    const Location<dim> inside = in_tree(x, false);
    if (inside.cell != invalid)
      return inside.cell < mesh.n_owned_cells() ? inside : Location<dim>();
    const CellTree<dim> &tree    = *mesh.cell_tree();
    const auto           nearest = tree.nearest_on_walls(x);
    std::vector<unsigned int> ranks;
    tree.ranks_around(x, nearest.distance, ranks);
    const bool may_be_elsewhere =
      ranks.size() != 1 || ranks[0] != Utilities::MPI::this_mpi_process(mesh.communicator());
    return may_be_elsewhere ? Location<dim>() : on_wall(nearest);
  }

  template <int dim>
  Location<dim>
  Locator<dim>::locate_here(const Point<dim> &x) const
  {
    const bool          on_lattice = mesh.lattice() != nullptr;
    const Location<dim> inside     = on_lattice ? in_lattice(x) : in_tree(x, true);
    if (inside.cell != invalid || on_lattice)
      return inside;
    return on_wall(mesh.cell_tree()->nearest_on_walls(x));
  }

  template <int dim>
  std::vector<typename Locator<dim>::Owner>
  Locator<dim>::owners(const std::vector<Point<dim>> &x) const
  {
    if (mesh.lattice() == nullptr)
      return owners_in_tree(x);
    std::vector<Point<dim>> moved;
    moved.reserve(x.size());
    for (const Point<dim> &p : x)
      moved.push_back(moved_to_box(p));
    const std::vector<unsigned int> ranks = mesh.octree().owner_ranks(moved);
    std::vector<Owner>              result;
    result.reserve(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      result.push_back({ranks[i], moved[i]});
    return result;
  }

  template <int dim>
  std::vector<typename Locator<dim>::Owner>
  Locator<dim>::owners_in_tree(const std::vector<Point<dim>> &x) const
  {
    // each rank that may have the cell tells how far it is, its number, and the point
    const CellTree<dim>      &tree = *mesh.cell_tree();
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
        if (answer[0] < distance[i] - tree.tolerance ||
            (answer[0] <= distance[i] + tree.tolerance && answer[1] < number[i]))
          {
            distance[i]    = answer[0];
            number[i]      = answer[1];
            result[i].rank = whom[k];
            for (unsigned int d = 0; d < dim; ++d)
              result[i].point[d] = answer[2 + d];
          }
      }
    return result;
  }

  template <int dim>
  std::vector<Point<dim>>
  Locator<dim>::clamped(const std::vector<Point<dim>> &x) const
  {
    std::vector<Point<dim>>   result, asked;
    std::vector<unsigned int> elsewhere;
    result.reserve(x.size());
    for (const Point<dim> &p : x)
      {
        result.push_back(moved_to_box(p));
        if (mesh.lattice() != nullptr)
          continue;
        const Location<dim> location = locate(p);
        result.back()                = location.point;
        if (location.cell != invalid)
          continue;
        elsewhere.push_back(result.size() - 1);
        asked.push_back(p);
      }
    if (mesh.lattice() != nullptr)
      return result;
    const std::vector<Owner> owner = owners_in_tree(asked);
    for (unsigned int k = 0; k < asked.size(); ++k)
      result[elsewhere[k]] = owner[k].point;
    return result;
  }

  template class Locator<2>;
  template class Locator<3>;
} // namespace treacle
