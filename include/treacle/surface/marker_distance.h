// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_distance_h
#define treacle_surface_marker_distance_h

#include <treacle/surface/marker_sheet.h>

#include <optional>

namespace treacle
{
  struct ThinPart
  {
    static constexpr double facing_away = -0.3; ///< cosine of the angle between its sides, or a gap's, at most
    static constexpr double deep        = 1.5001; ///< leaves, at most, that its nodes are from the surface, and a trifle more
  };

  template <int dim>
  AroundPoint<dim>
  view(const std::vector<const NearMarker<dim> *> &markers)
  {
    return AroundPoint<dim>(markers.data(), markers.size());
  }

  /// phi at a point from the markers @p near it, if any, where leaves have a size of @p h (m), and it was @p old; those on the far
  /// side of a thin part or of a corner from the @p nearest do not
  /// count. Where phi is smooth it has only to become zero at them, if @p phi_is_known there: their values. None where they
  /// do not know better.
  template <int dim>
  std::optional<double>
  corrected(const Point<dim>      &x,
            const double           old,
            const AroundPoint<dim> near,
            const Marker<dim>     &nearest,
            const double           h,
            const bool             phi_is_known);

  /// The same in a film, liquid between two sheets of markers; none if the point lies in none.
  template <int dim>
  std::optional<double>
  corrected_in_film(const Point<dim>      &x,
                    const double           old,
                    const AroundPoint<dim> near,
                    const Marker<dim>     &nearest,
                    const double           h);

  /// The part of the way to what the markers say that corrected() goes.
  template <int dim>
  double
  part_corrected(const Point<dim> &x, const AroundPoint<dim> near, const Marker<dim> &nearest, const double h);
} // namespace treacle

#endif
