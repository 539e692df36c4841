// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_balancing_h
#define treacle_solvers_balancing_h

#include <treacle/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <vector>

namespace treacle
{
  /// Vectors that a matrix hardly sees, as many for each of several parts that it does not couple, and zero in
  /// the others.
  struct PartMotions
  {
    unsigned int              n_parts = 0;   ///< on all ranks together
    unsigned int              n_motions = 0; ///< of each part
    std::vector<unsigned int> rows;          ///< owned ones that belong to a part, from the first row of this rank
    std::vector<unsigned int> part;          ///< of each
    std::vector<double>       values;        ///< n_motions for each
  };

  /// Makes a symmetric preconditioner exact for the motions of parts, as balancing domain decomposition does for
  /// those of subdomains (J. Mandel, Comm. Numer. Methods Engrg. 9, 1993, 233-241).
  class Balancing
  {
  public:
    using Operator = std::function<void(Vector &, const Vector &)>;

    /// Motions that depend on others, or whose energy is rounding, are left out. Collective.
    Balancing(const dealii::TrilinosWrappers::SparseMatrix &matrix, PartMotions motions);

    /// z = (Q + (1 - Q A) M (1 - A Q)) r, with M the @p preconditioner and Q the inverse of A among motions. Collective.
    void
    apply(Vector &z, const Vector &r, const Operator &preconditioner) const;

  private:
    /// Of each part and motion with the motions of the part, and by the @p diagonal of the matrix alone.
    std::vector<double>
    energies(const std::vector<double> &diagonal) const;

    /// Products of each part's vectors with x, over all ranks.
    std::vector<double>
    products(const std::vector<double> &vectors, const Vector &x) const;

    /// x += factor times the sum of vectors, each with its coefficient.
    void
    add(Vector                    &x,
        const double               factor,
        const std::vector<double> &coefficients,
        const std::vector<double> &vectors) const;

    void
    make_orthonormal(const std::vector<double> &diagonal);

    const MPI_Comm      comm;
    PartMotions         parts;  ///< orthonormal in the energy of the matrix
    std::vector<double> images; ///< the matrix times each
  };
} // namespace treacle

#endif
