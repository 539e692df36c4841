// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_matrix_rows_h
#define treacle_solvers_matrix_rows_h

#include <treacle/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

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
    /// The next row of this rank, each column once, in ascending order.
    void
    append(const MatrixRow &row);

    /// @p others in ascending order; those without an entry are left out, for ML takes it
    /// that two ranks need one another or do not. A matrix @p alike has the same entries, with
    /// other values; its graph is shared. Collective. Nothing is left.
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    take(const MPI_Comm                       &comm,
         const IndexSet                       &rows,
         const std::vector<GlobalIndex>       &others,
         const TrilinosWrappers::SparseMatrix *alike = nullptr);

  private:
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    make(const MPI_Comm &comm, const IndexSet &rows, const std::vector<GlobalIndex> &others);

    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    make_alike(const TrilinosWrappers::SparseMatrix &alike) const;

    std::vector<int>    lengths, columns;
    std::vector<double> values;
  };
} // namespace treacle

#endif
