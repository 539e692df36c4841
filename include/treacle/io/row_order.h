// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_row_order_h
#define treacle_io_row_order_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Rows of numbers, one for each cell, in the order of the cells' numbers, which no
  /// partition changes: rank r holds an equal share of them.
  template <int dim>
  class RowOrder
  {
  public:
    /// @p size: numbers in a row.
    RowOrder(const Mesh<dim> &mesh, const unsigned int size);

    /// From rows in the order of owned cells to the share of this rank. Collective.
    std::vector<double>
    shares(const std::vector<double> &rows) const;

    /// The reverse. Collective.
    std::vector<double>
    rows(const std::vector<double> &share) const;

    /// Numbers before, and in, the share of this rank.
    std::size_t
    offset() const
    {
      return first * size;
    }

    std::size_t
    n_numbers() const
    {
      return n_rows * size;
    }

  private:
    const Mesh<dim>                      &mesh;
    const unsigned int                    size;
    GlobalIndex                           first = 0, n_rows = 0;
    std::vector<std::vector<LocalIndex>>  sent_to;       ///< owned cells by the rank of their row
    std::vector<std::vector<GlobalIndex>> received_from; ///< numbers of rows by their cell's rank
  };
} // namespace treacle

#endif
