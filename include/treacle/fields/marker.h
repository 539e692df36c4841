// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_marker_h
#define treacle_fields_marker_h

#include <treacle/mesh/locator.h>

namespace treacle
{
  /// A massless point on the surface. It remembers where the surface is better than
  /// phi does, and its normal which side of it is liquid.
  template <int dim>
  struct Marker
  {
    Point<dim>     position; ///< m
    Tensor<1, dim> normal;   ///< unit, out of the liquid

    /// For files and messages: position, then normal.
    using Numbers = std::array<double, 2 * dim>;

    Numbers
    numbers() const
    {
      Numbers n;
      for (unsigned int d = 0; d < dim; ++d)
        {
          n[d]       = position[d];
          n[dim + d] = normal[d];
        }
      return n;
    }

    static Marker
    from(const double *n)
    {
      Marker marker;
      for (unsigned int d = 0; d < dim; ++d)
        {
          marker.position[d] = n[d];
          marker.normal[d]   = n[dim + d];
        }
      return marker;
    }
  };

  template <int dim>
  std::vector<Point<dim>>
  positions(const std::vector<Marker<dim>> &markers);

  /// Each marker on the rank that owns the cell it lies in, of a lattice the leaf. Collective.
  template <int dim>
  std::vector<Marker<dim>>
  to_owners(const Mesh<dim> &mesh, const std::vector<Marker<dim>> &markers);
} // namespace treacle

#endif
