// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_exchange_h
#define treacle_base_exchange_h

#include <treacle/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace treacle
{
  /// What each rank is sent, or what came from each rank.
  template <typename T>
  using PerRank = std::vector<std::vector<T>>;

  /// Of what each rank has. Collective.
  inline std::uint64_t
  sum_of_lower_ranks(const MPI_Comm &comm, const std::uint64_t here)
  {
    std::uint64_t before = 0;
    MPI_Exscan(&here, &before, 1, MPI_UINT64_T, MPI_SUM, comm);
    return before;
  }

  /// Send to_rank[r] to rank r and return what came from each rank. Collective.
  /// T must be trivially copyable. MPI counts with 32 bits: a message has @p most entries.
  template <typename T>
  PerRank<T>
  send_and_receive(const MPI_Comm     &comm,
                   const PerRank<T>   &to_rank,
                   const std::uint64_t most = 1u << 30)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    const unsigned int         n = to_rank.size();
    std::vector<std::uint64_t> n_send(n), n_receive(n);
    for (unsigned int r = 0; r < n; ++r)
      n_send[r] = to_rank[r].size();
    MPI_Alltoall(n_send.data(), 1, MPI_UINT64_T, n_receive.data(), 1, MPI_UINT64_T, comm);
    const auto in_parts = [&](auto *data, const std::uint64_t n, const auto &start) {
      for (std::uint64_t done = 0; done < n; done += most)
        start(data + done, static_cast<int>(std::min(most, n - done)));
    };

    PerRank<T> from_rank(n);
    const auto rank = dealii::Utilities::MPI::this_mpi_process(comm);
    MPI_Datatype type;
    MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    std::vector<MPI_Request> requests;
    for (unsigned int r = 0; r < n; ++r)
      if (r == rank)
        from_rank[r] = to_rank[r];
      else if (n_receive[r] > 0)
        {
          from_rank[r].resize(n_receive[r]);
          in_parts(from_rank[r].data(), n_receive[r], [&](T *data, const int n) {
            requests.emplace_back();
            MPI_Irecv(data, n, type, r, 0, comm, &requests.back());
          });
        }
    for (unsigned int r = 0; r < n; ++r)
      if (r != rank)
        in_parts(to_rank[r].data(), n_send[r], [&](const T *data, const int n) {
          requests.emplace_back();
          MPI_Isend(data, n, type, r, 0, comm, &requests.back());
        });
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    MPI_Type_free(&type);
    return from_rank;
  }

  /// The rank that knows of a key, for ranks to meet there.
  inline unsigned int
  meeting_rank(const std::uint64_t key, const unsigned int n_ranks)
  {
    return (key * 0x9e3779b97f4a7c15ull >> 32) % n_ranks;
  }

  /// Throw on every rank the UserError of the lowest rank on which @p message
  /// is not empty; return if there is none. Collective.
  inline void
  throw_first(const MPI_Comm &comm, const std::string &message)
  {
    const unsigned int n = dealii::Utilities::MPI::n_mpi_processes(comm);
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    const unsigned int first =
      dealii::Utilities::MPI::min(message.empty() ? n : rank, comm);
    if (first < n)
      throw UserError(dealii::Utilities::MPI::broadcast(comm, message, first));
  }
} // namespace treacle

#endif
