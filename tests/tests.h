// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_h
#define treacle_tests_h

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
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

  /// What the first of a group of ranks that are at work beside the first of all has to say.
  inline std::ostringstream &
  kept_output()
  {
    static std::ostringstream stream;
    return stream;
  }

  /// The file that the harness compares; only the first rank writes.
  inline std::ostream &
  out()
  {
    static std::ofstream stream;
    static const bool    is_first = [] {
      const bool is = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      if (is)
        stream.open("output");
      return is;
    }();
    return is_first ? static_cast<std::ostream &>(stream) : kept_output();
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

  /// Run on the ranks of each group, those of number -1 wait, in the directory @p where names for so many ranks.
  inline void
  run_in_groups(const int                                              group,
                const std::function<std::string(const unsigned int)>  &where,
                const std::function<void(const MPI_Comm &)>           &body)
  {
    MPI_Comm comm;
    MPI_Comm_split(MPI_COMM_WORLD, group + 1, dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD), &comm);
    kept_output().str("");
    if (group >= 0)
      {
        const unsigned int n = dealii::Utilities::MPI::n_mpi_processes(comm);
        out() << "ranks: " << n << std::endl;
        const auto here = std::filesystem::current_path(), there = here / where(n);
        std::filesystem::create_directories(there);
        std::filesystem::current_path(there);
        body(comm);
        std::filesystem::current_path(here);
      }
    MPI_Comm_free(&comm);
    wait_for_all();
  }

  /// Run on 1, 2 and 3 of the 3 ranks of this program, or on the number of them alone
  /// that the environment variable TREACLE_TEST_RANKS names. Runs on 1 and on 2 are at work at the same time; each has a directory of its own.
  inline void
  on_1_2_3_ranks(const std::function<void(const MPI_Comm &)> &body)
  {
    const int  rank      = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const auto directory = [](const unsigned int n) { return "ranks_" + std::to_string(n); };
    if (const char *only = std::getenv("TREACLE_TEST_RANKS"))
      return run_in_groups(rank < std::atoi(only) ? 0 : -1, directory, body);
    run_in_groups(rank == 0 ? 0 : 1, directory, body);
    const auto said = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, kept_output().str());
    if (rank == 0)
      out() << said[1];
    run_in_groups(0, directory, body);
  }

  /// The same one after the other in one directory: for tests whose runs read each other's files.
  inline void
  in_turn_on_1_2_3_ranks(const std::function<void(const MPI_Comm &)> &body)
  {
    const int   rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const char *only = std::getenv("TREACLE_TEST_RANKS");
    for (int n = only ? std::atoi(only) : 1; n <= (only ? std::atoi(only) : 3); ++n)
      run_in_groups(rank < n ? 0 : -1, [](const unsigned int) { return "."; }, body);
  }
} // namespace tests

#endif
