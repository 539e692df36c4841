// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_matrix_rows_h
#define treacle_solvers_matrix_rows_h

#include <treacle/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Epetra_CrsMatrix.h>

namespace treacle
{
  /// Columns and values.
  using MatrixRow = std::vector<std::pair<int, double>>;

  /// A square sparse matrix in the making, each row whole on the rank that owns it. Columns are
  /// local: this rank's rows, then those of others that it knows. What deal.II offers looks up
  /// and sorts each global index.
  class MatrixRows
  {
  public:
    /// @p others in ascending order; @p lengths bounds the entries of each row. Collective.
    MatrixRows(const MPI_Comm                  &comm,
               const IndexSet                  &rows,
               const std::vector<GlobalIndex>  &others,
               const std::vector<unsigned int> &lengths);

    /// The entries of a row of this rank, each column once, in ascending order.
    void
    insert(const unsigned int row, const MatrixRow &entries);

    /// Collective. Nothing is left.
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    take();

  private:
    Epetra_Map                        row_map;
    std::unique_ptr<Epetra_CrsMatrix> matrix;
    std::vector<int>                  columns; ///< scratch, as values are
    std::vector<double>               values;
  };
} // namespace treacle

#endif
