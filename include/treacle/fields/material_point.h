// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_material_point_h
#define treacle_fields_material_point_h

#include <deal.II/base/point.h>

#include <array>

namespace treacle
{
  using namespace dealii;

  /// A point of the liquid that moves with it, and its material, which never changes.
  template <int dim>
  struct MaterialPoint
  {
    Point<dim> position;  ///< m
    double     density;   ///< kg/m^dim
    double     viscosity; ///< Pa s

    /// For files and messages: position, density, viscosity.
    using Numbers = std::array<double, dim + 2>;

    Numbers
    numbers() const
    {
      Numbers n;
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = position[d];
      n[dim]     = density;
      n[dim + 1] = viscosity;
      return n;
    }

    static MaterialPoint
    from(const double *n)
    {
      MaterialPoint point{Point<dim>(), n[dim], n[dim + 1]};
      for (unsigned int d = 0; d < dim; ++d)
        point.position[d] = n[d];
      return point;
    }
  };
} // namespace treacle

#endif
