// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_table_file_h
#define treacle_io_table_file_h

#include <treacle/base/types.h>

#include <string>
#include <vector>

namespace treacle
{
  /// A binary file of numbers that all ranks write and read together, each its
  /// own part. All throw a UserError on all ranks if that fails. Collective.
  template <typename T>
  class TableFile
  {
  public:
    /// The parts of all ranks, one behind the other.
    static void
    write(const MPI_Comm &comm, const std::string &path, const std::vector<T> &part);

    /// @p n numbers behind the first @p offset; may differ between ranks.
    static std::vector<T>
    read(const MPI_Comm    &comm,
         const std::string &path,
         const std::uint64_t offset,
         const std::uint64_t n);
  };
} // namespace treacle

#endif
