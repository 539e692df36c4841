// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_h
#define treacle_tests_h

#include <deal.II/base/mpi.h>

#include <fstream>
#include <functional>

namespace tests
{
  /// The file that the harness compares; only the first rank writes.
  inline std::ostream &
  out()
  {
    static std::ofstream stream = [] {
      std::ofstream s;
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        s.open("output");
      else
        s.setstate(std::ios::badbit);
      return s;
    }();
    return stream;
  }

  /// Run on 1, 2 and 3 of the 3 ranks of this program in turn.
  inline void
  on_1_2_3_ranks(const std::function<void(const MPI_Comm &)> &body)
  {
    const int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    for (int n = 1; n <= 3; ++n)
      {
        MPI_Comm comm;
        MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : 1, rank, &comm);
        if (rank < n)
          {
            out() << "ranks: " << n << std::endl;
            body(comm);
          }
        MPI_Comm_free(&comm);
        MPI_Barrier(MPI_COMM_WORLD);
      }
  }
} // namespace tests

#endif
