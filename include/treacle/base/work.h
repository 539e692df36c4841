// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_work_h
#define treacle_base_work_h

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <string>

namespace treacle
{
  using namespace dealii;

  /// What this rank has done since it started: a slip in speed shows in it without a clock.
  struct Work
  {
    std::uint64_t cells_made           = 0; ///< of meshes
    std::uint64_t points_located       = 0; ///< in cells
    std::uint64_t facets_tried         = 0; ///< in searches for the nearest
    std::uint64_t products             = 0; ///< with the matrix or operator of a solve
    std::uint64_t preconditionings     = 0; ///< of a vector in a solve, by multigrid mostly
    std::uint64_t preconditioners_made = 0;
    std::uint64_t bytes_allocated      = 0; ///< by new

    static Work &
    here()
    {
      static Work work;
      return work;
    }

    /// A table of it: what has to do with solves once, for all ranks do the same, the others
    /// summed up. Collective.
    static std::string
    summary(const MPI_Comm &comm);
  };
} // namespace treacle

#endif
