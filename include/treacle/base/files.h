// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_files_h
#define treacle_base_files_h

#include <mpi.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace treacle
{
  /// Rank 0 creates a directory and those above it. Throws a UserError on all
  /// ranks. Collective.
  void
  create_directory(const MPI_Comm &comm, const std::string &directory);

  /// Write a file under a temporary name and rename it, so that a kill leaves
  /// the old file or the new one, never half of it. Returns what went wrong, or
  /// an empty string; not collective.
  std::string
  replace_file(const std::string &path, const std::function<void(std::ostream &)> &write);

  /// The same on rank 0. Throws a UserError on all ranks. Collective.
  void
  replace_file(const MPI_Comm                            &comm,
               const std::string                         &path,
               const std::function<void(std::ostream &)> &write);
} // namespace treacle

#endif
