// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_near_markers_h
#define treacle_surface_near_markers_h

#include <treacle/fields/marker.h>

namespace treacle
{
  /// A marker, and a value that belongs to it.
  template <int dim>
  struct NearMarker
  {
    Marker<dim> marker;
    double      value;
  };

  /// The one nearest to @p x of some, at least one.
  template <int dim>
  const Marker<dim> &
  nearest(const Point<dim> &x, const std::vector<const NearMarker<dim> *> &markers)
  {
    const auto distance = [&](const auto *m) { return (x - m->marker.position).norm_square(); };
    return (*std::min_element(markers.begin(),
                              markers.end(),
                              [&](const auto *a, const auto *b) { return distance(a) < distance(b); }))
      ->marker;
  }

  /// Finds the markers within a reach of points in this rank's cells.
  template <int dim>
  class NearMarkers
  {
  public:
    /// @p markers of this rank, with @p values; collective.
    NearMarkers(const Mesh<dim>                &mesh,
                const std::vector<Marker<dim>> &markers,
                const std::vector<double>      &values,
                const double                    reach);

    /// Markers closer to @p x than the reach.
    void
    around(const Point<dim> &x, std::vector<const NearMarker<dim> *> &result) const;

    const double reach; ///< m

  private:
    /// Of the grid of cubes of edge reach.
    LatticePoint<dim>
    cube_of(const Point<dim> &x) const;

    void
    sort_into_cubes();

    const Point<dim>                                                      origin;
    std::vector<NearMarker<dim>>                                          all;
    std::unordered_map<VertexKey, std::pair<unsigned int, unsigned int>> cubes; ///< begin, end
  };
} // namespace treacle

#endif
