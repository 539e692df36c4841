// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_decoupled_h
#define treacle_solvers_decoupled_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace treacle
{
  /// A multiple of the entries that couple each component with itself, of a matrix whose
  /// rows take turns among @p n_components, on each rank from the first on. Collective.
  std::unique_ptr<dealii::TrilinosWrappers::SparseMatrix>
  decoupled(const dealii::TrilinosWrappers::SparseMatrix &matrix,
            const unsigned int                            n_components,
            const double                                  factor);
} // namespace treacle

#endif
