// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_ghost_cells_h
#define treacle_mesh_ghost_cells_h

#include <treacle/base/exchange.h>
#include <treacle/base/types.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace treacle
{
  /// The other ranks that named the same keys. Collective.
  std::unordered_map<VertexKey, std::vector<unsigned int>>
  sharing_ranks(const MPI_Comm &comm, const std::unordered_set<VertexKey> &keys);

  /// Give each record to all ranks that share one of its vertices, and sort what
  /// this rank has then by id. A record has an id and the keys of its vertices; those
  /// that another rank may have too are in @p candidates. Collective.
  template <typename Record>
  void
  exchange_ghosts(const MPI_Comm                      &comm,
                  const std::unordered_set<VertexKey> &candidates,
                  std::vector<Record>                 &records)
  {
    const auto      sharers = sharing_ranks(comm, candidates);
    PerRank<Record> to_rank(Utilities::MPI::n_mpi_processes(comm));
    for (const Record &record : records)
      {
        std::set<unsigned int> ranks;
        for (const VertexKey key : record.vertex)
          if (const auto it = sharers.find(key); it != sharers.end())
            ranks.insert(it->second.begin(), it->second.end());
        for (const unsigned int r : ranks)
          to_rank[r].push_back(record);
      }
    for (const auto &received : send_and_receive(comm, to_rank))
      records.insert(records.end(), received.begin(), received.end());
    std::sort(records.begin(), records.end(), [](const Record &a, const Record &b) {
      return a.id < b.id;
    });
  }
} // namespace treacle

#endif
