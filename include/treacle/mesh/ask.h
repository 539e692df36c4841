// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_ask_h
#define treacle_mesh_ask_h

#include <treacle/base/exchange.h>
#include <treacle/base/types.h>

namespace treacle
{
  /// Ask rank whom[i] about the point x[i]: there @p answer (point, numbers) gives
  /// n numbers, which are [i * n] to [i * n + n - 1] of the result. Collective.
  template <int dim, typename Answer>
  std::vector<double>
  ask(const MPI_Comm                  &comm,
      const std::vector<unsigned int> &whom,
      const std::vector<Point<dim>>   &x,
      const unsigned int               n,
      const Answer                    &answer)
  {
    const unsigned int               n_ranks = Utilities::MPI::n_mpi_processes(comm);
    PerRank<std::array<double, dim>> questions(n_ranks);
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        questions[whom[i]].emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          questions[whom[i]].back()[d] = x[i][d];
      }
    const auto      received = send_and_receive(comm, questions);
    PerRank<double> answers(n_ranks);
    for (unsigned int r = 0; r < n_ranks; ++r)
      {
        answers[r].resize(received[r].size() * n);
        for (unsigned int i = 0; i < received[r].size(); ++i)
          {
            Point<dim> p;
            for (unsigned int d = 0; d < dim; ++d)
              p[d] = received[r][i][d];
            answer(p, &answers[r][i * n]);
          }
      }
    const auto                heard = send_and_receive(comm, answers);
    std::vector<unsigned int> next(n_ranks, 0);
    std::vector<double>       result;
    result.reserve(x.size() * n);
    for (const unsigned int rank : whom)
      for (unsigned int k = 0; k < n; ++k)
        result.push_back(heard[rank][next[rank]++]);
    return result;
  }
} // namespace treacle

#endif
