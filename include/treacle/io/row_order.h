// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_row_order_h
#define treacle_io_row_order_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Rows that one rank reads and writes of those that all ranks share.
  struct Share
  {
    std::uint64_t first, n;
  };

  /// The share of @p rank: as many rows as the others have, but for the last ones.
  inline Share
  share_of(const std::uint64_t rank, const std::uint64_t n_ranks, const std::uint64_t n_rows)
  {
    const std::uint64_t most  = (n_rows + n_ranks - 1) / n_ranks;
    const std::uint64_t first = std::min(rank * most, n_rows);
    return {first, std::min(most, n_rows - first)};
  }

  /// Rows of numbers, one for each cell, in the order of the cells' numbers, which no
  /// partition changes: each rank holds a share of them.
  template <int dim>
  class RowOrder
  {
  public:
    /// @p sizes: numbers in the row of each owned cell. Collective.
    RowOrder(const Mesh<dim> &mesh, const std::vector<unsigned int> &sizes);

    /// From rows in the order of owned cells to the share of this rank. Collective.
    std::vector<double>
    shares(const std::vector<double> &rows) const;

    /// The reverse. Collective.
    std::vector<double>
    rows(const std::vector<double> &share) const;

    /// Numbers before, and in, the share of this rank.
    std::uint64_t
    offset() const
    {
      return n_before;
    }

    std::uint64_t
    n_numbers() const
    {
      return start.back();
    }

  private:
    const MPI_Comm comm;
    /// Where the rows of owned cells begin, and those of the share; with the ends.
    std::vector<std::uint64_t>              own_start, start;
    std::uint64_t                           n_before = 0;
    std::vector<std::vector<LocalIndex>>    sent_to;       ///< owned cells by the rank of their row
    std::vector<std::vector<std::uint64_t>> received_from; ///< rows of the share by their cell's rank
  };
} // namespace treacle

#endif
