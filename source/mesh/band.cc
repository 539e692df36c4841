// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/band.h>

#include <map>
#include <unordered_set>

namespace treacle
{
  namespace
  {
    template <typename T>
    void
    sort_unique(std::vector<T> &v)
    {
      std::sort(v.begin(), v.end());
      v.erase(std::unique(v.begin(), v.end()), v.end());
    }

    /// The octant, or what lies between some, that a normal points to; points of one cube
    /// with the same one ask for the same cubes.
    template <int dim>
    LatticePoint<dim>
    direction(const Tensor<1, dim> &normal)
    {
      constexpr double  sin_of_a_quarter_of_a_right_angle = 0.3827;
      LatticePoint<dim> signs{};
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(normal[d]) > sin_of_a_quarter_of_a_right_angle)
          signs[d] = normal[d] < 0 ? -1 : 1;
      return signs;
    }

    /// From the cube of a point to those that it asks for, in cubes.
    template <int dim>
    std::vector<LatticePoint<dim>>
    steps(const BandWidths &widths, const LatticePoint<dim> &outward)
    {
      const int n = std::max(1., std::max(widths.inner, widths.outer));
      std::vector<LatticePoint<dim>> result;
      unsigned int                   n_all = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_all *= 2 * n + 1;
      for (unsigned int k = 0; k < n_all; ++k)
        {
          LatticePoint<dim> step;
          int               along = 0, square = 0, longest = 0;
          for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 2 * n + 1)
            {
              step[d] = static_cast<int>(rest % (2 * n + 1)) - n;
              along += step[d] * outward[d];
              square += step[d] * step[d];
              longest = std::max(longest, std::abs(step[d]));
            }
          const double width = along > 0 ? widths.outer : widths.inner;
          if (longest <= 1 ||
              (outward != LatticePoint<dim>{} && square <= width * width))
            result.push_back(step);
        }
      return result;
    }

    template <int dim>
    Point<dim>
    centre_of_cube(const Octree<dim> &octree, const VertexKey cube, const int size)
    {
      return octree.position(Leaf<dim>{unpack<dim>(cube), size, 0}.centre());
    }
  } // namespace

  template <int dim>
  std::optional<VertexKey>
  Band<dim>::cube_at(const VertexKey cube, const LatticePoint<dim> &step, const LatticePoint<dim> &extent) const
  {
    LatticePoint<dim> other = unpack<dim>(cube);
    for (unsigned int d = 0; d < dim; ++d)
      {
        other[d] += size * step[d];
        if (other[d] < 0 || other[d] >= extent[d])
          return {};
      }
    return pack<dim>(other);
  }

  template <int dim>
  Band<dim>::Band(const Octree<dim>                             &octree,
                  const unsigned int                             level,
                  const std::vector<BandPoint<dim>>             &points,
                  const BandWidths                              &widths,
                  const std::function<bool(const Point<dim> &)> &is_needed)
    : comm(octree.communicator())
    , root(2 << octree.parameters().surface_level)
    , size(root >> level)
  {
    std::map<LatticePoint<dim>, std::vector<VertexKey>> by_direction;
    for (const BandPoint<dim> &point : points)
      by_direction[direction(point.outward)].push_back(
        pack<dim>(cube_around<dim>(octree.finest_cube(point.position), size)));
    for (auto &[outward, asking] : by_direction)
      {
        sort_unique(asking);
        at_points.insert(at_points.end(), asking.begin(), asking.end());
        for (const LatticePoint<dim> &step : steps<dim>(widths, outward))
          for (const VertexKey cube : asking)
            if (const auto other = cube_at(cube, step, octree.extent()))
              cubes.push_back(*other);
      }
    std::string error;
    for (std::vector<VertexKey> *list : {&cubes, &at_points})
      {
        sort_unique(*list);
        keep_error(error, [&] {
          list->erase(std::remove_if(list->begin(),
                                     list->end(),
                                     [&](const VertexKey cube) {
                                       return !is_needed(centre_of_cube(octree, cube, size));
                                     }),
                      list->end());
        });
      }
    throw_first(comm, error);
  }

  template <int dim>
  GlobalIndex
  Band<dim>::n_in_larger_leaves(const Octree<dim>            &octree,
                                const std::vector<VertexKey> &list) const
  {
    // each is told to the owner of its leaf
    std::vector<Point<dim>> centres;
    for (const VertexKey cube : list)
      centres.push_back(centre_of_cube(octree, cube, size));
    const std::vector<unsigned int> owner = octree.owner_ranks(centres);
    PerRank<VertexKey>              to_rank(Utilities::MPI::n_mpi_processes(comm));
    for (unsigned int i = 0; i < list.size(); ++i)
      to_rank[owner[i]].push_back(list[i]);
    std::unordered_set<VertexKey> found;
    for (const auto &received : send_and_receive(comm, to_rank))
      for (const VertexKey cube : received)
        if (const LocalIndex leaf = octree.leaf_containing(centre_of_cube(octree, cube, size));
            leaf == invalid || octree.leaves()[leaf].size > size)
          found.insert(cube);
    return Utilities::MPI::sum(GlobalIndex(found.size()), comm);
  }

  template <int dim>
  typename Band<dim>::Missing
  Band<dim>::missing_in(const Octree<dim> &octree) const
  {
    return {n_in_larger_leaves(octree, at_points), n_in_larger_leaves(octree, cubes)};
  }

  namespace
  {
    /// Which of the keys @p asked does any rank hold? Collective.
    std::vector<bool>
    held_somewhere(const MPI_Comm               &comm,
                   const std::vector<VertexKey> &held,
                   const std::vector<VertexKey> &asked)
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
      PerRank<VertexKey> told(n_ranks), questions(n_ranks);
      for (const VertexKey key : held)
        told[meeting_rank(key, n_ranks)].push_back(key);
      for (const VertexKey key : asked)
        questions[meeting_rank(key, n_ranks)].push_back(key);
      std::unordered_set<VertexKey> known;
      for (const auto &list : send_and_receive(comm, told))
        known.insert(list.begin(), list.end());
      questions = send_and_receive(comm, questions);
      PerRank<char> answers(n_ranks);
      for (unsigned int r = 0; r < n_ranks; ++r)
        for (const VertexKey key : questions[r])
          answers[r].push_back(known.count(key) > 0);
      const auto                heard = send_and_receive(comm, answers);
      std::vector<unsigned int> next(n_ranks, 0);
      std::vector<bool>         result;
      for (const VertexKey key : asked)
        {
          const unsigned int r = meeting_rank(key, n_ranks);
          result.push_back(heard[r][next[r]++] != 0);
        }
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<bool>
  Band<dim>::touches(const std::vector<Leaf<dim>> &leaves) const
  {
    // ranks without leaves of this level do not know it
    const unsigned int level =
      Utilities::MPI::max(leaves.empty() ? 0u : leaves.front().level, comm);
    if (root >> level <= size)
      return std::vector<bool>(leaves.size(), false);

    std::vector<VertexKey> of_cubes, of_leaves;
    for (const VertexKey cube : cubes)
      of_cubes.push_back(pack<dim>(cube_around<dim>(unpack<dim>(cube), root >> level)));
    sort_unique(of_cubes);
    for (const Leaf<dim> &leaf : leaves)
      of_leaves.push_back(pack<dim>(leaf.origin));
    return held_somewhere(comm, of_cubes, of_leaves);
  }

  template class Band<2>;
  template class Band<3>;
} // namespace treacle
