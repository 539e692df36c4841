// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_gauss_seidel_h
#define treacle_solvers_gauss_seidel_h

#include <treacle/solvers/unit_triangle.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Epetra_CrsMatrix.h>

#include <vector>

namespace treacle
{
  /// A symmetric positive definite matrix A between the halves of its symmetric Gauss-Seidel preconditioner. With D its diagonal,
  /// and `I + L + U` what is on this rank of `D^(-1/2) A D^(-1/2)`, it is `S = (I + L)^-1 D^(-1/2) A D^(-1/2) (I + U)^-1`. A product
  /// with S reads A once, as one with A does (S. C. Eisenstat, Efficient implementation of a class of preconditioned conjugate
  /// gradient methods, SIAM J. Sci. Stat. Comput. 2, 1981).
  class GaussSeidel
  {
  public:
    /// The entries of a row stand in the order of their local columns. The matrix must outlive this object.
    explicit GaussSeidel(const TrilinosWrappers::SparseMatrix &matrix);

    /// y = S x. Collective.
    void
    vmult(Vector &y, const Vector &x) const;

    /// `y = (I + L)^-1 D^(-1/2) r`: the right-hand side for S.
    void
    forward(Vector &y, const Vector &r) const;

    /// `y = D^(-1/2) (I + U)^-1 x`: the solution with A that x is with S.
    void
    backward(Vector &y, const Vector &x) const;

  private:
    /// Places of its entries.
    struct Row
    {
      int begin, diagonal, first_ghost, end;
    };

    Row
    find_row(const int row) const;

    /// Three rows with their entries in the same columns, as those of the components of a node have, are a group, others by
    /// themselves.
    void
    set_triangles(const std::vector<Row> &rows);

    /// The part of a group of rows that is in the lower triangle.
    void
    append_below(const std::vector<Row> &rows, const int first, const int n);

    void
    append_above(const std::vector<Row> &rows, const int first, const int n);

    double
    scaled(const int row, const int place) const
    {
      return scale[row] * value[place] * scale[column[place]];
    }

    /// To y what the rows of other ranks' solution add to a product with D^(-1/2) A D^(-1/2).
    void
    add_ghosts(Vector &y) const;

    const Epetra_CrsMatrix          &matrix;
    int                             *begin, *column; ///< of its rows; of its entries, local ones
    double                          *value;
    std::vector<double>              scale;         ///< D^(-1/2)
    std::vector<std::pair<int, int>> ghost_entries; ///< rows, and places of entries of other ranks' columns
    UnitTriangle                     lower, upper;
    mutable std::vector<double>      solution; ///< scratch: (I + U)^-1 x
  };
} // namespace treacle

#endif
