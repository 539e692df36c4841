// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/solvers/matrix_rows.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace treacle
{
  MatrixRows::MatrixRows(const TrilinosWrappers::SparseMatrix *alike)
    : alike(alike)
  {
    if (alike != nullptr)
      values.reserve(alike->trilinos_matrix().NumMyNonzeros());
  }

  void
  MatrixRows::append(const MatrixRow &row)
  {
    Assert(std::is_sorted(row.begin(), row.end()), ExcMessage("Columns of a row are not in ascending order."));
    for (const auto &[column, value] : row)
      values.push_back(value);
    if (alike != nullptr)
      return;
    for (const auto &[column, value] : row)
      columns.push_back(column);
    lengths.push_back(row.size());
  }

  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  MatrixRows::take(const MPI_Comm &comm, const IndexSet &rows, const std::vector<GlobalIndex> &others)
  {
    auto result = std::make_unique<TrilinosWrappers::SparseMatrix>();
    if (alike != nullptr)
      result->reinit(*alike); // shares its graph
    else
      {
        Epetra_CrsMatrix zeros(Copy, graph(comm, rows, others));
        zeros.FillComplete();
        result->reinit(zeros, false);
      }
    const Epetra_CrsMatrix &matrix = result->trilinos_matrix();
    AssertThrow(matrix.NumMyNonzeros() == static_cast<int>(values.size()),
                ExcMessage("A matrix has other entries than the one it is to be like."));
    if (!values.empty())
      std::copy(values.begin(), values.end(), matrix[0]);
    *this = MatrixRows();
    return result;
  }

  Epetra_CrsGraph
  MatrixRows::graph(const MPI_Comm &comm, const IndexSet &rows, const std::vector<GlobalIndex> &others)
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
    Epetra_CrsGraph  result(Copy, row_map, column_map, lengths.data(), true);
    int              error = 0;
    for (int row = 0, begin = 0; row < n_rows; begin += lengths[row++])
      error = std::min(error, result.InsertMyIndices(row, lengths[row], columns.data() + begin));
    error = std::min({error, result.FillComplete(row_map, row_map), result.OptimizeStorage()});
    AssertThrow(error >= 0, ExcMessage("A matrix could not be completed."));
    return result;
  }
} // namespace treacle
