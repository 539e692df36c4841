// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_timing_h
#define treacle_base_timing_h

#include <deal.II/base/timer.h>

#include <map>
#include <string>

namespace treacle
{
  using namespace dealii;

  /// Where the wall time goes. Ranks measure on their own, without waiting for
  /// one another; the slowest counts.
  class Timing
  {
  public:
    explicit Timing(const MPI_Comm &comm);

    /// Measures until the returned object goes out of scope. Sections may nest.
    [[nodiscard]] TimerOutput::Scope
    section(const std::string &name)
    {
      return TimerOutput::Scope(timer, name);
    }

    /// What @p work returns; it is a section.
    template <typename Work>
    auto
    measured(const std::string &name, const Work &work)
    {
      const auto scope = section(name);
      return work();
    }

    /// Seconds since construction, on this rank.
    double
    total() const
    {
      return clock.wall_time();
    }

    /// Seconds so far in each section, of the rank that took longest. Collective.
    std::map<std::string, double>
    seconds() const;

    /// A table of the sections and the peak memory. Collective.
    std::string
    summary() const;

    /// The summary as the file timing.txt. Collective.
    void
    write(const std::string &directory) const;

  private:
    MPI_Comm    comm;
    TimerOutput timer;
    Timer       clock;
  };
} // namespace treacle

#endif
