// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/band.h>

#include <map>
#include <optional>
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

    /// Cubes side by side along the last axis: the keys of the first and the last one.
    struct Row
    {
      VertexKey first, last;
    };

    /// From the cube of a point to rows of those that it asks for, in cubes.
    template <int dim>
    struct Steps
    {
      LatticePoint<dim> first;
      int               length; ///< along the last axis
    };

    template <int dim>
    std::vector<Steps<dim>>
    steps(const BandWidths &widths, const LatticePoint<dim> &outward)
    {
      const int n = std::max(1., std::max(widths.inner, widths.outer));
      std::vector<Steps<dim>> result;
      unsigned int            n_all = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_all *= 2 * n + 1;
      bool goes_on = false;
      for (unsigned int k = 0; k < n_all; ++k)
        {
          LatticePoint<dim> step;
          int               along = 0, square = 0, longest = 0;
          for (unsigned int d = dim, rest = k; d-- > 0; rest /= 2 * n + 1)
            {
              step[d] = static_cast<int>(rest % (2 * n + 1)) - n;
              along += step[d] * outward[d];
              square += step[d] * step[d];
              longest = std::max(longest, std::abs(step[d]));
            }
          const double width = along > 0 ? widths.outer : widths.inner;
          const bool   is_asked =
            longest <= 1 || (outward != LatticePoint<dim>{} && square <= width * width);
          if (is_asked && goes_on && step[dim - 1] > -n)
            ++result.back().length;
          else if (is_asked)
            result.push_back({step, 1});
          goes_on = is_asked;
        }
      return result;
    }

    /// Cubes of the edge @p size with these keys, sorted.
    std::vector<Row>
    rows_of(const std::vector<VertexKey> &keys, const int size)
    {
      std::vector<Row> rows;
      for (const VertexKey key : keys)
        if (!rows.empty() && key == rows.back().last + size)
          rows.back().last = key;
        else
          rows.push_back({key, key});
      return rows;
    }

    /// The cubes in any of the rows, sorted.
    std::vector<VertexKey>
    cubes_in(std::vector<Row> rows, const int size)
    {
      std::sort(rows.begin(), rows.end(), [](const Row &a, const Row &b) { return a.first < b.first; });
      std::vector<VertexKey> cubes;
      for (const Row &row : rows)
        for (VertexKey cube = cubes.empty() ? row.first : std::max(row.first, cubes.back() + size); cube <= row.last;
             cube += size)
          cubes.push_back(cube);
      return cubes;
    }

    /// What cubes of the edge @p size in a row ask for, as far as the box goes to @p extent.
    template <int dim>
    std::optional<Row>
    moved(const Row &row, const Steps<dim> &steps, const int size, const LatticePoint<dim> &extent)
    {
      LatticePoint<dim> first = unpack<dim>(row.first), last = unpack<dim>(row.last);
      for (unsigned int d = 0; d < dim; ++d)
        {
          first[d] += size * steps.first[d];
          last[d] += size * steps.first[d];
        }
      constexpr unsigned int along = dim - 1;
      first[along]                 = std::max(first[along], 0);
      last[along] = std::min(last[along] + size * (steps.length - 1), extent[along] - size);
      for (unsigned int d = 0; d < dim; ++d)
        if (first[d] < 0 || last[d] >= extent[d] || first[d] > last[d])
          return {};
      return Row{pack<dim>(first), pack<dim>(last)};
    }

    template <int dim>
    Point<dim>
    centre_of_cube(const Octree<dim> &octree, const VertexKey cube, const int size)
    {
      return octree.position(Leaf<dim>{unpack<dim>(cube), size, 0}.centre());
    }
  } // namespace

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
    std::vector<Row> asked;
    for (auto &[outward, asking] : by_direction)
      {
        sort_unique(asking);
        at_points.insert(at_points.end(), asking.begin(), asking.end());
        const std::vector<Row> rows = rows_of(asking, size);
        for (const Steps<dim> &of_row : steps<dim>(widths, outward))
          for (const Row &row : rows)
            if (const auto other = moved<dim>(row, of_row, size, octree.extent()))
              asked.push_back(*other);
      }
    sort_unique(at_points);
    cubes = cubes_in(std::move(asked), size);
    std::string error;
    for (std::vector<VertexKey> *list : {&cubes, &at_points})
      keep_error(error, [&] {
        list->erase(std::remove_if(list->begin(),
                                   list->end(),
                                   [&](const VertexKey cube) {
                                     return !is_needed(centre_of_cube(octree, cube, size));
                                   }),
                    list->end());
      });
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
