// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_sheet_h
#define treacle_surface_marker_sheet_h

#include <treacle/surface/near_markers.h>

namespace treacle
{
  /// Markers around a point.
  template <int dim>
  using AroundPoint = ArrayView<const NearMarker<dim> *const>;

  /// Those of some that face a direction: with a normal of which more than a part lies
  /// along it.
  template <int dim>
  std::vector<const NearMarker<dim> *>
  facing(const AroundPoint<dim> &markers,
         const Tensor<1, dim>   &direction,
         const double            part)
  {
    std::vector<const NearMarker<dim> *> result;
    for (const NearMarker<dim> *m : markers)
      if (m->marker.normal * direction > part)
        result.push_back(m);
    return result;
  }

  /// The sheet of those markers around a point that face one way.
  template <int dim>
  class MarkerSheet
  {
  public:
    /// How far a marker is felt, in leaves.
    static constexpr double reach = 1.25;

    /// Wendland's function, whose Fourier transform is positive. With others the mean
    /// over markers turns the sign of waves as short as the leaves, and what is taken off
    /// makes them grow, step by step.
    static double
    weight(const double squared_distance, const double h)
    {
      const double r      = std::sqrt(squared_distance) / (reach * h);
      const double square = (1 - r) * (1 - r);
      return square * square * (4 * r + 1);
    }

    /// Of @p markers within the reach of @p x, at least one, where leaves have a size of
    /// @p h (m).
    MarkerSheet(const Point<dim> &x, const AroundPoint<dim> &markers, const double h);

    double         distance = 0; ///< of the point, signed (m)
    Tensor<1, dim> normal;       ///< mean of the markers', or 0
    bool           is_beside;    ///< the point lies beyond the sheet's end
    bool           surrounds;    ///< the point has markers on more sides than one
  };
} // namespace treacle

#endif
