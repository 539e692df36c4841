// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/solvers/unit_triangle.h>

namespace treacle
{
  void
  UnitTriangle::solve(double *x) const
  {
    const int    *column = columns.data();
    const double *value  = values.data();
    for (const auto &[first, n_rows, n_columns] : groups)
      if (const int *const end = column + n_columns; n_rows == 1)
        {
          double sum = x[first];
          for (; column != end; ++column, ++value)
            sum -= *value * x[*column];
          x[first] = sum;
        }
      else
        {
          double &y0 = x[first], &y1 = x[first + step], &y2 = x[first + 2 * step];
          double  s0 = y0, s1 = y1, s2 = y2;
          for (; column != end; ++column, value += 3)
            {
              const double known = x[*column];
              s0 -= value[0] * known;
              s1 -= value[1] * known;
              s2 -= value[2] * known;
            }
          s1 -= value[0] * s0;
          s2 -= value[1] * s0 + value[2] * s1;
          y0 = s0;
          y1 = s1;
          y2 = s2;
          value += 3;
        }
  }
} // namespace treacle
