// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/files.h>
#include <treacle/base/timing.h>
#include <treacle/base/work.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/map.hpp>

#include <algorithm>
#include <iostream>
#include <vector>

namespace treacle
{
  namespace
  {
    /// The largest value of any rank for each name.
    std::map<std::string, double>
    maximum(const MPI_Comm &comm, const std::map<std::string, double> &values)
    {
      std::map<std::string, double> result;
      for (const auto &of_rank : Utilities::MPI::all_gather(comm, values))
        for (const auto &[name, value] : of_rank)
          result[name] = std::max(result[name], value);
      return result;
    }
    std::string
    peak_memory(const MPI_Comm &comm)
    {
      Utilities::System::MemoryStats memory;
      Utilities::System::get_memory_stats(memory);
      const double peak = memory.VmHWM / 1024.; // MiB
      char         text[128];
      std::snprintf(text,
                    sizeof text,
                    "Peak memory: %.0f MiB in all, %.0f MiB on the largest of %u ranks",
                    Utilities::MPI::sum(peak, comm),
                    Utilities::MPI::max(peak, comm),
                    Utilities::MPI::n_mpi_processes(comm));
      return text;
    }
  } // namespace

  // a TimerOutput that knows the communicator would wait for all ranks at the
  // end of each section, for ever if one of them has failed
  Timing::Timing(const MPI_Comm &comm)
    : comm(comm)
    , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
  {}

  std::map<std::string, double>
  Timing::seconds() const
  {
    return maximum(comm, timer.get_summary_data(TimerOutput::total_wall_time));
  }

  std::string
  Timing::summary() const
  {
    const auto   times = seconds();
    const auto   calls = maximum(comm, timer.get_summary_data(TimerOutput::n_calls));
    const double total = Utilities::MPI::max(clock.wall_time(), comm);

    std::vector<std::pair<std::string, double>> sorted(times.begin(), times.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto &a, const auto &b) {
      return a.second > b.second;
    });
    char text[128];
    std::snprintf(text,
                  sizeof text,
                  "%-32s %8s %12s %7s\n",
                  "Section",
                  "calls",
                  "wall time",
                  "share");
    std::string table = text;
    const auto  add =
      [&](const std::string &name, const unsigned int n, const double time) {
        std::snprintf(text,
                      sizeof text,
                      "%-32s %8u %10.2f s %5.1f %%\n",
                      name.c_str(),
                      n,
                      time,
                      100 * time / total);
        table += text;
      };
    for (const auto &[name, time] : sorted)
      add(name, calls.at(name), time);
    add("Total", 1, total);
    return table + peak_memory(comm) + "\n" + Work::summary(comm);
  }

  void
  Timing::write(const std::string &directory) const
  {
    const std::string text = summary();
    replace_file(comm, directory + "/timing.txt", [&](std::ostream &out) {
      out << text << '\n';
    });
  }
} // namespace treacle
