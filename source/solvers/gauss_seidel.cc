// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/solvers/gauss_seidel.h>

#include <Epetra_Import.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace treacle
{
  GaussSeidel::GaussSeidel(const TrilinosWrappers::SparseMatrix &a)
    : matrix(a.trilinos_matrix())
    , lower(1)
    , upper(-1)
  {
    AssertThrow(matrix.ExtractCrsDataPointers(begin, column, value) == 0,
                ExcMessage("The rows of a matrix are not stored one after the other."));
    std::vector<Row> rows;
    for (int i = 0; i < matrix.NumMyRows(); ++i)
      {
        rows.push_back(find_row(i));
        scale.push_back(1 / std::sqrt(value[rows[i].diagonal]));
        for (int place = rows[i].first_ghost; place < rows[i].end; ++place)
          ghost_entries.emplace_back(i, place);
      }
    set_triangles(rows);
  }

  typename GaussSeidel::Row
  GaussSeidel::find_row(const int row) const
  {
    const int *first = column + begin[row], *last = column + begin[row + 1];
    Assert(std::is_sorted(first, last), ExcInternalError());
    const int *diagonal = std::lower_bound(first, last, row), *ghost = std::lower_bound(diagonal, last, matrix.NumMyRows());
    const Row  result{
      begin[row], static_cast<int>(diagonal - column), static_cast<int>(ghost - column), begin[row + 1]};
    AssertThrow(diagonal != ghost && *diagonal == row && value[result.diagonal] > 0,
                ExcMessage("A row of a matrix has no positive diagonal."));
    return result;
  }

  void
  GaussSeidel::set_triangles(const std::vector<Row> &rows)
  {
    const auto is_alike = [&](const int first, const int other) {
      const Row &a = rows[first], &b = rows[other];
      return b.diagonal - b.begin == a.diagonal - a.begin + other - first &&
             std::equal(column + b.begin, column + b.end, column + a.begin, column + a.end);
    };
    std::vector<std::pair<int, int>> groups;
    const int                        n_rows = rows.size();
    for (int i = 0; i < n_rows; i += groups.back().second)
      groups.emplace_back(i, i + 2 < n_rows && is_alike(i, i + 1) && is_alike(i, i + 2) ? 3 : 1);
    for (const auto &[first, n] : groups)
      append_below(rows, first, n);
    for (auto group = groups.rbegin(); group != groups.rend(); ++group)
      append_above(rows, group->first, group->second);
  }

  void
  GaussSeidel::append_below(const std::vector<Row> &rows, const int first, const int n)
  {
    lower.start(first, n);
    for (int k = 0; k < rows[first].diagonal - rows[first].begin; ++k)
      {
        lower.add_column(column[rows[first].begin + k]);
        for (int i = first; i < first + n; ++i)
          lower.add(scaled(i, rows[i].begin + k));
      }
    for (int i = first + 1; i < first + n; ++i)
      for (int place = rows[i].diagonal - (i - first); place < rows[i].diagonal; ++place)
        lower.add(scaled(i, place));
  }

  void
  GaussSeidel::append_above(const std::vector<Row> &rows, const int first, const int n)
  {
    const int last = first + n - 1;
    upper.start(last, n);
    for (int k = 1; k < rows[last].first_ghost - rows[last].diagonal; ++k)
      {
        upper.add_column(column[rows[last].first_ghost - k]);
        for (int i = last; i >= first; --i)
          upper.add(scaled(i, rows[i].first_ghost - k));
      }
    for (int i = last - 1; i >= first; --i)
      for (int place = rows[i].diagonal + (last - i); place > rows[i].diagonal; --place)
        upper.add(scaled(i, place));
  }

  void
  GaussSeidel::forward(Vector &y, const Vector &r) const
  {
    for (unsigned int i = 0; i < scale.size(); ++i)
      y.local_element(i) = scale[i] * r.local_element(i);
    lower.solve(y.begin());
  }

  void
  GaussSeidel::backward(Vector &y, const Vector &x) const
  {
    std::copy_n(x.begin(), scale.size(), y.begin());
    upper.solve(y.begin());
    for (unsigned int i = 0; i < scale.size(); ++i)
      y.local_element(i) *= scale[i];
  }

  void
  GaussSeidel::vmult(Vector &y, const Vector &x) const
  {
    // (I + L + U) t = (I + L) t + x - t, where t = (I + U)^-1 x
    solution.assign(x.begin(), x.begin() + scale.size());
    upper.solve(solution.data());
    for (unsigned int i = 0; i < scale.size(); ++i)
      y.local_element(i) = x.local_element(i) - solution[i];
    add_ghosts(y);
    lower.solve(y.begin());
    for (unsigned int i = 0; i < scale.size(); ++i)
      y.local_element(i) += solution[i];
  }

  void
  GaussSeidel::add_ghosts(Vector &y) const
  {
    const Epetra_Import *importer = matrix.Importer();
    if (importer == nullptr)
      return;
    Epetra_Vector here(matrix.DomainMap(), false), all(matrix.ColMap(), false);
    for (unsigned int i = 0; i < scale.size(); ++i)
      here[i] = scale[i] * solution[i];
    all.Import(here, *importer, Insert);
    for (const auto &[row, place] : ghost_entries)
      y.local_element(row) += scale[row] * value[place] * all[column[place]];
  }
} // namespace treacle
