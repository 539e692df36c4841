// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_near_markers_h
#define treacle_surface_near_markers_h

#include <treacle/base/exchange.h>
#include <treacle/fields/marker.h>
#include <treacle/mesh/cube_grid.h>

#include <deal.II/base/array_view.h>

#include <limits>

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
  nearest(const Point<dim> &x, const ArrayView<const NearMarker<dim> *const> markers)
  {
    const NearMarker<dim> *result = nullptr;
    double                 least  = std::numeric_limits<double>::max();
    for (const NearMarker<dim> *m : markers)
      if (const double square = (x - m->marker.position).norm_square(); square < least)
        {
          least  = square;
          result = m;
        }
    return result->marker;
  }

  /// Finds the markers within a reach of points in this rank's cells, or beyond these.
  template <int dim>
  class NearMarkers
  {
  public:
    /// @p markers of this rank; points are no further than @p beyond (m) from this rank's cells. Collective.
    NearMarkers(const Mesh<dim>                &mesh,
                const std::vector<Marker<dim>> &markers,
                const double                    reach,
                const double                    beyond = 0);

    /// Of this rank's markers, in their order; 0 before. Collective.
    void
    set_values(const std::vector<double> &values);

    /// Add the markers closer to @p x than the reach to @p result. They stay where they are.
    void
    append_around(const Point<dim> &x, std::vector<const NearMarker<dim> *> &result) const;

  private:
    void
    sort_into_cubes();

    const MPI_Comm                                                        comm;
    const CubeGrid<dim>                                                   grid; ///< edge: the reach
    PerRank<unsigned int>                                                 sent; ///< markers, to ranks
    std::vector<NearMarker<dim>>                                          all;
    std::vector<Point<dim>>                                               position; ///< theirs; many are looked at, few taken
    /// In all, of this rank's markers and then of those it was sent.
    std::vector<unsigned int>                                             place;
    /// Begin and end in all of what is in a cube and the two beside it along x.
    std::unordered_map<VertexKey, std::pair<unsigned int, unsigned int>> rows;
  };



  /// The same with a reach of so many leaves, which are smaller here and larger there.
  template <int dim>
  class MarkersWithinLeaves
  {
  public:
    /// @p markers of this rank; points are no further than @p beyond from its cells, in leaves too. Collective.
    MarkersWithinLeaves(const Mesh<dim>                &mesh,
                        const std::vector<Marker<dim>> &markers,
                        const double                    leaves,
                        const double                    beyond = 0);

    /// See NearMarkers. Collective.
    void
    set_values(const std::vector<double> &values);

    /// Those within the reach that leaves of a size (m) give.
    void
    append_around(const Point<dim>                     &x,
                  const double                          size,
                  std::vector<const NearMarker<dim> *> &result) const;

  private:
    const double                  finest;
    std::vector<NearMarkers<dim>> of_size; ///< from the finest on, each twice as large
  };
} // namespace treacle

#endif
