// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/solvers/decoupled.h>
#include <treacle/solvers/matrix_rows.h>

#include <Epetra_CrsMatrix.h>

namespace treacle
{
  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  decoupled(const TrilinosWrappers::SparseMatrix &matrix,
            const unsigned int                    n_components,
            const double                          factor)
  {
    const Epetra_CrsMatrix &all    = matrix.trilinos_matrix();
    const int               n_rows = all.NumMyRows();
    // columns are this rank's rows, then those of others
    std::vector<unsigned int> component;
    std::vector<GlobalIndex>  others;
    for (int column = 0; column < all.NumMyCols(); ++column)
      {
        component.push_back(all.GCID(column) % n_components);
        if (column >= n_rows)
          others.push_back(all.GCID(column));
      }
    MatrixRows rows;
    MatrixRow  row;
    for (int i = 0; i < n_rows; ++i)
      {
        int     n_entries, *columns;
        double *values;
        all.ExtractMyRowView(i, n_entries, values, columns);
        row.clear();
        for (int k = 0; k < n_entries; ++k)
          if (component[columns[k]] == component[i])
            row.emplace_back(columns[k], factor * values[k]);
        rows.append(row);
      }
    return rows.take(matrix.get_mpi_communicator(),
                     matrix.locally_owned_range_indices(),
                     others);
  }
} // namespace treacle
