// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_carried_in_cell_h
#define treacle_fields_carried_in_cell_h

#include <treacle/fields/state.h>

namespace treacle
{
  /// Largest over smallest value in a cell that make a jump: less is smooth.
  constexpr double least_jump = 1.5;

  /// A property that is carried, in a cell: P1, or where it jumps one of two values. Between them lies
  /// what the P1 function has in the middle, for the means at nodes tell how much of each is about.
  template <int dim>
  class CarriedInCell
  {
  public:
    CarriedInCell(const Mesh<dim> &mesh, const CarriedField &field, const LocalIndex cell)
      : mean(mesh.values(cell, field.mean))
      , least(std::numeric_limits<double>::max())
      , largest(-least)
    {
      for (const LocalIndex node : mesh.cell_nodes[cell])
        {
          least   = std::min(least, field.least.local_element(node));
          largest = std::max(largest, field.largest.local_element(node));
        }
    }

    bool
    jumps() const
    {
      return largest > least_jump * least;
    }

    /// P1, at barycentric coordinates.
    double
    smooth(const VertexValues<dim> &lambda) const
    {
      double value = 0;
      for (unsigned int i = 0; i <= dim; ++i)
        value += lambda[i] * mean[i];
      return value;
    }

    /// One of the two; a tie is not left to roundoff.
    double
    sharp(const VertexValues<dim> &lambda) const
    {
      return smooth(lambda) > least + (0.5 + 1e-9) * (largest - least) ? largest : least;
    }

    const VertexValues<dim> mean; ///< at the nodes
    double                  least, largest;
  };
} // namespace treacle

#endif
