// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/solvers/matrix_rows.h>

namespace treacle
{
  MatrixRows::MatrixRows(const MPI_Comm                  &comm,
                         const IndexSet                  &rows,
                         const std::vector<GlobalIndex>  &others,
                         const std::vector<unsigned int> &lengths)
    : row_map(rows.make_trilinos_map(comm, false))
  {
    std::vector<int> known(row_map.MyGlobalElements(),
                           row_map.MyGlobalElements() + row_map.NumMyElements());
    known.insert(known.end(), others.begin(), others.end());
    const Epetra_Map       column_map(-1, known.size(), known.data(), 0, row_map.Comm());
    const std::vector<int> n_entries(lengths.begin(), lengths.end());
    matrix = std::make_unique<Epetra_CrsMatrix>(Copy, row_map, column_map, n_entries.data(), true);
  }

  void
  MatrixRows::insert(const unsigned int row, const MatrixRow &entries)
  {
    columns.clear();
    values.clear();
    for (const auto &[column, value] : entries)
      {
        columns.push_back(column);
        values.push_back(value);
      }
    const int error = matrix->InsertMyValues(row, columns.size(), values.data(), columns.data());
    AssertThrow(error >= 0, ExcMessage("A row of a matrix is longer than was said."));
  }

  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  MatrixRows::take()
  {
    const int error = matrix->FillComplete(row_map, row_map);
    AssertThrow(error >= 0, ExcMessage("A matrix could not be completed."));
    auto result = std::make_unique<TrilinosWrappers::SparseMatrix>();
    result->reinit(*matrix);
    matrix.reset();
    return result;
  }
} // namespace treacle
