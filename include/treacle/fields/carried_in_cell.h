// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_carried_in_cell_h
#define treacle_fields_carried_in_cell_h

#include <treacle/fields/state.h>

namespace treacle
{
  /// Largest over smallest value that make a jump: less is smooth.
  constexpr double least_jump = 1.5;

  /// The two values between which a property jumps, as several nodes know them.
  class TwoValues
  {
  public:
    /// Of a node; where they are the same it knows of no jump.
    void
    add(const double least, const double largest)
    {
      if (!(least < largest))
        return;
      lower = {{std::min(lower[0], least), std::max(lower[1], least)}};
      upper = {{std::min(upper[0], largest), std::max(upper[1], largest)}};
    }

    /// Do nodes know of them, and do they agree? Where three materials meet they do not.
    bool
    exist() const
    {
      return lower[0] <= upper[1] && lower[1] <= least_jump * lower[0] &&
             upper[1] <= least_jump * upper[0];
    }

    double
    least() const
    {
      return lower[0];
    }

    double
    largest() const
    {
      return upper[1];
    }

  private:
    static constexpr double huge = std::numeric_limits<double>::max();
    /// Smallest and largest of each.
    std::array<double, 2> lower = {{huge, -huge}}, upper = {{huge, -huge}};
  };



  /// A property that is carried, in a cell: P1, or where it jumps one of two values. Between them lies
  /// what the P1 function has in the middle, for the means at nodes tell how much of each is about.
  template <int dim>
  class CarriedInCell
  {
  public:
    CarriedInCell(const Mesh<dim> &mesh, const CarriedField &field, const LocalIndex cell)
      : mean(mesh.values(cell, field.mean))
    {
      for (const LocalIndex node : mesh.cell_nodes[cell])
        two.add(field.least.local_element(node), field.largest.local_element(node));
    }

    bool
    jumps() const
    {
      return two.exist();
    }

    /// If it jumps.
    const TwoValues &
    values() const
    {
      return two;
    }

    /// At barycentric coordinates.
    double
    value(const VertexValues<dim> &lambda) const
    {
      const double smooth = interpolate(mean, lambda);
      if (!jumps())
        return smooth;
      // a tie is not left to roundoff
      return smooth > two.least() + (0.5 + 1e-9) * (two.largest() - two.least()) ? two.largest() : two.least();
    }

  private:
    const VertexValues<dim> mean; ///< at the nodes
    TwoValues               two;
  };
} // namespace treacle

#endif
