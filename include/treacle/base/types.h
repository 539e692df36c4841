// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_types_h
#define treacle_base_types_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <cstdint>
#include <sstream>

namespace treacle
{
  using namespace dealii;

  /// Values per node, face, cell or unknown: owned ones first, then ghosts.
  using Vector = LinearAlgebra::distributed::Vector<double>;

  /// Set all elements, owned and ghost, which are then ready for compress().
  inline void
  fill(Vector &v, const double value)
  {
    v.zero_out_ghost_values();
    const unsigned int n = v.locally_owned_size() + v.get_partitioner()->n_ghost_indices();
    for (unsigned int i = 0; i < n; ++i)
      v.local_element(i) = value;
  }

  /// The packed integer coordinates of a lattice vertex, the same on every rank.
  using VertexKey = std::uint64_t;

  /// Index of an owned or ghost cell, node or face on this rank.
  using LocalIndex = unsigned int;

  /// Index of a cell, node or face over all ranks.
  using GlobalIndex = types::global_dof_index;

  constexpr LocalIndex invalid = numbers::invalid_unsigned_int;

  /// The coordinates, separated by commas.
  template <int dim>
  std::string
  to_text(const Point<dim> &x, const int precision)
  {
    std::ostringstream text;
    text.precision(precision);
    text << x[0];
    for (unsigned int d = 1; d < dim; ++d)
      text << ", " << x[d];
    return text.str();
  }
} // namespace treacle

#endif
