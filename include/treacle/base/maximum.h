// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_maximum_h
#define treacle_base_maximum_h

#include <mpi.h>

#include <array>
#include <cmath>
#include <limits>

namespace treacle
{
  /// The larger of two numbers; not a number if either is none, where std::max may drop it.
  inline double
  larger(const double a, const double b)
  {
    return std::isnan(b) || a < b ? b : a;
  }

  /// The largest over all ranks, entry by entry; not a number where a rank has none, which
  /// MPI_MAX may drop. Collective.
  template <std::size_t n>
  std::array<double, n>
  largest(const MPI_Comm &comm, const std::array<double, n> &values)
  {
    std::array<double, 2 * n> parts; // the numbers; 1 where there is none
    for (std::size_t i = 0; i < n; ++i)
      {
        parts[n + i] = std::isnan(values[i]) ? 1. : 0.;
        parts[i]     = std::isnan(values[i]) ? -std::numeric_limits<double>::max() : values[i];
      }
    MPI_Allreduce(MPI_IN_PLACE, parts.data(), 2 * n, MPI_DOUBLE, MPI_MAX, comm);
    std::array<double, n> result;
    for (std::size_t i = 0; i < n; ++i)
      result[i] = parts[n + i] > 0 ? std::numeric_limits<double>::quiet_NaN() : parts[i];
    return result;
  }

  inline double
  largest(const MPI_Comm &comm, const double value)
  {
    return largest<1>(comm, {{value}})[0];
  }
} // namespace treacle

#endif
