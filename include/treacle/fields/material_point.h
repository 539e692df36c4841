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
    /// What the nodes' means were where it was sown: how they go from one material to the other about a jump.
    double mean_density, mean_viscosity;

    /// For files and messages: position, density, viscosity, their means.
    using Numbers = std::array<double, dim + 4>;

    Numbers
    numbers() const
    {
      Numbers n;
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = position[d];
      n[dim]     = density;
      n[dim + 1] = viscosity;
      n[dim + 2] = mean_density;
      n[dim + 3] = mean_viscosity;
      return n;
    }

    static MaterialPoint
    from(const double *n)
    {
      MaterialPoint point{Point<dim>(), n[dim], n[dim + 1], n[dim + 2], n[dim + 3]};
      for (unsigned int d = 0; d < dim; ++d)
        point.position[d] = n[d];
      return point;
    }
  };
} // namespace treacle

#endif
