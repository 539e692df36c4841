// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/base/log.h>

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace treacle
{
  namespace
  {
    /// As in 1:02:03 or 2:03.
    std::string
    clock_time(const double seconds)
    {
      const long total = std::lround(seconds);
      char       text[32];
      if (total >= 3600)
        std::snprintf(text,
                      sizeof text,
                      "%ld:%02ld:%02ld",
                      total / 3600,
                      total / 60 % 60,
                      total % 60);
      else
        std::snprintf(text, sizeof text, "%ld:%02ld", total / 60, total % 60);
      return text;
    }

    bool
    is_terminal_here()
    {
      if (!isatty(STDOUT_FILENO))
        return false;
      if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
        return true;
      // mpirun gives its ranks a pseudo-terminal, wherever its own output goes
      const std::string of_parent = "/proc/" + std::to_string(getppid()) + "/fd/1";
      const int         file   = open(of_parent.c_str(), O_WRONLY | O_NOCTTY | O_APPEND);
      const bool        result = file >= 0 && isatty(file);
      if (file >= 0)
        close(file);
      return result;
    }
  } // namespace

  Log::Log(const MPI_Comm &comm, const std::string &directory, const bool append)
    : is_writer(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , is_terminal(is_writer && is_terminal_here())
  {
    create_directory(comm, directory);
    const std::string path = directory + "/log.txt";
    if (is_writer)
      file.open(path, append ? std::ios::app : std::ios::trunc);
    throw_first(comm,
                is_writer && !file ? "The file \"" + path + "\" cannot be written." : "");
  }

  Log::~Log()
  {
    erase_progress();
  }

  void
  Log::line(const std::string &text)
  {
    if (!is_writer)
      return;
    erase_progress();
    std::cout << text << std::endl;
    file << text << std::endl; // flushed: a log that stops early says where
  }

  void
  Log::progress(const double done)
  {
    if (!is_terminal)
      return;
    const auto now = Clock::now();
    if (first_done < 0)
      {
        first_done = done;
        first_time = now;
      }
    erase_progress();
    char text[32];
    std::snprintf(text, sizeof text, "%5.1f %% done", 100 * done);
    std::cout << text;
    if (done > first_done)
      {
        const double elapsed = std::chrono::duration<double>(now - first_time).count();
        std::cout << ", " << clock_time(elapsed * (1 - done) / (done - first_done))
                  << " left";
      }
    std::cout << std::flush;
    has_progress = true;
  }

  void
  Log::erase_progress()
  {
    if (has_progress)
      std::cout << "\r\033[K" << std::flush;
    has_progress = false;
  }
} // namespace treacle
