// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_material_property_h
#define treacle_surface_material_property_h

#include <treacle/fields/carried_in_cell.h>

namespace treacle
{
  /// One of the properties that make a material, at the nodes and of a material point.
  template <int dim>
  struct MaterialProperty
  {
    CarriedField &field;
    double MaterialPoint<dim>::*of_point;
    double MaterialPoint<dim>::*mean_of_point;
    /// Largest less smallest value anywhere.
    double spread = 0;

    /// Not by roundoff: leaves of a quarter of the box with something linear are no jump on any rank.
    bool
    jumps(const double least, const double largest) const
    {
      constexpr double more = 1 + 1e-9;
      return largest > more * least_jump * least || largest - least > std::max(0.25 * more * spread, 1e-9 * largest);
    }
  };
} // namespace treacle

#endif
