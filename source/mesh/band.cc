// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ask.h>
#include <treacle/mesh/band.h>

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
  } // namespace

  template <int dim>
  Band<dim>::Band(const Octree<dim>             &octree,
                  const std::vector<Point<dim>> &points,
                  const unsigned int             width)
    : comm(octree.communicator())
    , finest_level(octree.parameters().surface_level)
  {
    for (const Point<dim> &x : points)
      cubes.push_back(octree.finest_cube(x));
    sort_unique(cubes);
    const int w = width;
    for (unsigned int d = 0; d < dim; ++d)
      {
        std::vector<LatticePoint<dim>> grown;
        for (const LatticePoint<dim> &cube : cubes)
          for (int k = -w; k <= w; ++k)
            {
              LatticePoint<dim> other = cube;
              other[d] += 2 * k;
              if (other[d] >= 0 && other[d] < octree.extent()[d])
                grown.push_back(other);
            }
        sort_unique(grown);
        cubes = std::move(grown);
      }
  }

  template <int dim>
  bool
  Band<dim>::is_finest_in(const Octree<dim> &octree) const
  {
    // a cube that is not one of this rank's leaves is asked of its owner
    std::vector<Point<dim>> elsewhere;
    bool                    finest = true;
    for (const LatticePoint<dim> &cube : cubes)
      {
        LatticePoint<dim> centre = cube;
        for (int &i : centre)
          ++i;
        const Point<dim> x    = octree.position(centre);
        const LocalIndex leaf = octree.leaf_containing(x);
        if (leaf == invalid)
          elsewhere.push_back(x);
        else
          finest = finest && octree.leaves()[leaf].size == 2;
      }
    for (const double is_finest : ask(comm,
                                      octree.owner_ranks(elsewhere),
                                      elsewhere,
                                      1,
                                      [&](const Point<dim> &x, double *answer) {
                                        const LocalIndex leaf = octree.leaf_containing(x);
                                        *answer               = leaf != invalid &&
                                                  octree.leaves()[leaf].size == 2;
                                      }))
      finest = finest && is_finest == 1;
    return Utilities::MPI::min(finest ? 1 : 0, comm) == 1;
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
    const int root = 2 << finest_level;
    // ranks without leaves of this level do not know it
    const unsigned int level =
      Utilities::MPI::max(leaves.empty() ? 0u : leaves.front().level, comm);
    const int size = root >> level;

    std::vector<VertexKey> of_cubes, of_leaves;
    for (LatticePoint<dim> cube : cubes)
      {
        for (int &i : cube)
          i &= ~(size - 1);
        of_cubes.push_back(pack<dim>(cube));
      }
    sort_unique(of_cubes);
    for (const Leaf<dim> &leaf : leaves)
      of_leaves.push_back(pack<dim>(leaf.origin));
    return held_somewhere(comm, of_cubes, of_leaves);
  }

  template class Band<2>;
  template class Band<3>;
} // namespace treacle
