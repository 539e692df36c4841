// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_unit_triangle_h
#define treacle_solvers_unit_triangle_h

#include <treacle/base/types.h>

#include <vector>

namespace treacle
{
  /// A sparse triangular matrix with ones on its diagonal, to be solved with: its entries lie in memory in the order in which they are
  /// used, and three rows with entries in the same columns go together, for a row alone waits for the one before.
  class UnitTriangle
  {
  public:
    /// Rows are appended in the order in which they are solved for. @p step: from one row of a group to the next, 1 or -1.
    explicit UnitTriangle(const int step)
      : step(step)
    {}

    /// A group of one row, or of three, first, first + step, first + 2 step, whose entries follow.
    void
    start(const int first, const unsigned int n_rows)
    {
      groups.push_back({first, n_rows, 0});
    }

    /// A column, of rows that have been solved for, in which the last group has entries; by add() those of each row follow. At last
    /// those between the rows of three: of the second with the first, the third with the first and with the second.
    void
    add_column(const int column)
    {
      columns.push_back(column);
      ++groups.back().n_columns;
    }

    void
    add(const double value)
    {
      values.push_back(value);
    }

    /// Solve with it in place.
    void
    solve(double *x) const;

  private:
    struct Group
    {
      int          first;
      unsigned int n_rows, n_columns;
    };

    const int           step;
    std::vector<Group>  groups;
    std::vector<int>    columns;
    std::vector<double> values;
  };
} // namespace treacle

#endif
