// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_log_h
#define treacle_base_log_h

#include <mpi.h>

#include <chrono>
#include <fstream>
#include <string>

namespace treacle
{
  /// What a run tells: rank 0 writes it to the terminal and to log.txt.
  class Log
  {
  public:
    /// Creates the directory. With @p append an older log.txt is continued.
    /// Throws a UserError on all ranks. Collective.
    Log(const MPI_Comm &comm, const std::string &directory, const bool append);

    /// Ends the progress line.
    ~Log();

    Log(const Log &) = delete;

    /// One line, or several with '\n' between them.
    void
    line(const std::string &text);

    /// Redraw the last line of a terminal: the part of the run that is done,
    /// in [0,1], and the time left if it goes on like this. Goes nowhere else.
    void
    progress(const double done);

  private:
    using Clock = std::chrono::steady_clock;

    void
    erase_progress();

    bool              is_writer;
    bool              is_terminal;
    bool              has_progress = false;
    std::ofstream     file;
    double            first_done = -1; ///< at the first call of progress()
    Clock::time_point first_time;
  };
} // namespace treacle

#endif
