// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/solvers/matrix_rows.h>

#include <Epetra_CrsMatrix.h>

namespace treacle
{
  void
  MatrixRows::append(const MatrixRow &row)
  {
    const std::size_t n = columns.size();
    columns.resize(n + row.size());
    values.resize(n + row.size());
    for (std::size_t k = 0; k < row.size(); ++k)
      std::tie(columns[n + k], values[n + k]) = row[k];
    lengths.push_back(row.size());
  }

  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  MatrixRows::take(const MPI_Comm                       &comm,
                   const IndexSet                       &rows,
                   const std::vector<GlobalIndex>       &others,
                   const TrilinosWrappers::SparseMatrix *alike)
  {
    auto result = alike == nullptr ? make(comm, rows, others) : make_alike(*alike);
    *this       = MatrixRows();
    return result;
  }

  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  MatrixRows::make_alike(const TrilinosWrappers::SparseMatrix &alike) const
  {
    auto result = std::make_unique<TrilinosWrappers::SparseMatrix>();
    result->reinit(alike); // shares its graph
    const Epetra_CrsMatrix &matrix = result->trilinos_matrix();
    AssertThrow(matrix.NumMyNonzeros() == static_cast<int>(values.size()),
                ExcMessage("A matrix has other entries than the one it is to be like."));
    if (!values.empty())
      std::copy(values.begin(), values.end(), matrix[0]);
    return result;
  }

  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  MatrixRows::make(const MPI_Comm                 &comm,
                   const IndexSet                 &rows,
                   const std::vector<GlobalIndex> &others)
  {
    const Epetra_Map row_map = rows.make_trilinos_map(comm, false);
    const int        n_rows  = row_map.NumMyElements();
    std::vector<int> place(n_rows + others.size(), 0); // first 1 where used
    for (const int column : columns)
      place[column] = 1;
    std::vector<int> known(row_map.MyGlobalElements(), row_map.MyGlobalElements() + n_rows);
    for (int column = 0; column < static_cast<int>(place.size()); ++column)
      if (column < n_rows)
        place[column] = column;
      else if (place[column] == 1)
        {
          place[column] = known.size();
          known.push_back(others[column - n_rows]);
        }
    for (int &column : columns)
      column = place[column];

    const Epetra_Map column_map(-1, known.size(), known.data(), 0, row_map.Comm());
    Epetra_CrsMatrix matrix(Copy, row_map, column_map, lengths.data(), true);
    int              error = 0;
    for (int row = 0, begin = 0; row < n_rows; begin += lengths[row++])
      error = std::min(
        error,
        matrix.InsertMyValues(row, lengths[row], values.data() + begin, columns.data() + begin));
    error = std::min(error, matrix.FillComplete(row_map, row_map));
    AssertThrow(error >= 0, ExcMessage("A matrix could not be completed."));
    auto result = std::make_unique<TrilinosWrappers::SparseMatrix>();
    result->reinit(matrix);
    return result;
  }
} // namespace treacle
