// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_h
#define treacle_tests_h

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>

namespace tests
{
  /// A test of the program treacle_tests, under the name of its file: room/name. Arguments
  /// are for a person who wants more than what is compared.
  struct Test
  {
    using Function = void (*)(const int argc, char **argv);

    Test(const std::string &name, const Function function)
    {
      all().emplace(name, function);
    }

    static std::map<std::string, Function> &
    all()
    {
      static std::map<std::string, Function> tests;
      return tests;
    }
  };

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

  /// A barrier in which idle ranks leave the cores to the busy ones.
  inline void
  wait_for_all()
  {
    MPI_Request request;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (int is_done = 0; !is_done; MPI_Test(&request, &is_done, MPI_STATUS_IGNORE))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  /// Run on 1, 2 and 3 of the 3 ranks of this program in turn, or on the number of them alone
  /// that the environment variable TREACLE_TEST_RANKS names.
  inline void
  on_1_2_3_ranks(const std::function<void(const MPI_Comm &)> &body)
  {
    const int   rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const char *only = std::getenv("TREACLE_TEST_RANKS");
    for (int n = only ? std::atoi(only) : 1; n <= (only ? std::atoi(only) : 3); ++n)
      {
        MPI_Comm comm;
        MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : 1, rank, &comm);
        if (rank < n)
          {
            out() << "ranks: " << n << std::endl;
            body(comm);
          }
        MPI_Comm_free(&comm);
        wait_for_all();
      }
  }
} // namespace tests

#endif
