// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_matrix_rows_h
#define treacle_solvers_matrix_rows_h

#include <treacle/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

class Epetra_CrsGraph;

namespace treacle
{
  /// Columns and values.
  using MatrixRow = std::vector<std::pair<unsigned int, double>>;

  /// A square sparse matrix in the making, each row whole on the rank that owns it. Columns are
  /// local: this rank's rows, then those of others that it knows. What deal.II offers looks up
  /// and sorts each global index.
  class MatrixRows
  {
  public:
    /// A matrix @p alike, or none, has the same entries, with other values; its graph is shared.
    explicit MatrixRows(const TrilinosWrappers::SparseMatrix *alike = nullptr);

    /// The next row of this rank, each column once, in ascending order.
    void
    append(const MatrixRow &row);

    /// @p others in ascending order; those without an entry are left out, for ML takes it
    /// that two ranks need one another or do not. Collective. Nothing is left.
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    take(const MPI_Comm &comm, const IndexSet &rows, const std::vector<GlobalIndex> &others);

  private:
    /// Changes columns.
    Epetra_CrsGraph
    graph(const MPI_Comm &comm, const IndexSet &rows, const std::vector<GlobalIndex> &others);

    const TrilinosWrappers::SparseMatrix *alike;
    std::vector<int>                      lengths, columns; ///< none where a matrix is alike
    std::vector<double>                   values;
  };
} // namespace treacle

#endif
