// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ghost_cells.h>

namespace treacle
{
  std::unordered_map<VertexKey, std::vector<unsigned int>>
  sharing_ranks(const MPI_Comm &comm, const std::unordered_set<VertexKey> &keys)
  {
    struct Pair
    {
      VertexKey    key;
      unsigned int rank;
    };
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    PerRank<VertexKey> named(n_ranks);
    for (const VertexKey key : keys)
      named[meeting_rank(key, n_ranks)].push_back(key);
    const PerRank<VertexKey> heard = send_and_receive(comm, named);

    std::unordered_map<VertexKey, std::vector<unsigned int>> who;
    for (unsigned int r = 0; r < n_ranks; ++r)
      for (const VertexKey key : heard[r])
        who[key].push_back(r);
    PerRank<Pair> answer(n_ranks);
    for (const auto &[key, ranks] : who)
      for (const unsigned int r : ranks)
        for (const unsigned int other : ranks)
          if (other != r)
            answer[r].push_back({key, other});

    std::unordered_map<VertexKey, std::vector<unsigned int>> result;
    for (const auto &pairs : send_and_receive(comm, answer))
      for (const Pair &pair : pairs)
        result[pair.key].push_back(pair.rank);
    return result;
  }
} // namespace treacle
