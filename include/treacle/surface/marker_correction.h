// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_correction_h
#define treacle_surface_marker_correction_h

#include <treacle/fields/state.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/near_markers.h>

#include <deal.II/base/array_view.h>

namespace treacle
{
  /// Brings phi at the nodes within 1.25 leaves of markers to the surface the markers lie
  /// on.
  template <int dim>
  class MarkerCorrection
  {
  public:
    /// Its markers, which stay where they are. Collective.
    explicit MarkerCorrection(const State<dim> &state);

    /// Correct phi of the same state. Collective.
    void
    apply(State<dim> &state);

  private:
    using Near = ArrayView<const NearMarker<dim> *const>;

    /// Markers around a node, with leaves of a size (m) beside it.
    Near
    around(const LocalIndex node, const double size);

    const Mesh<dim>                                      &mesh;
    const std::vector<Point<dim>>                         position;
    Guesses                                               guesses; ///< for the positions
    MarkersWithinLeaves<dim>                              markers;
    std::vector<const NearMarker<dim> *>                  near;    ///< of one node after another
    std::vector<std::pair<unsigned int, unsigned int>>    of_node; ///< begin and end, once known
  };
} // namespace treacle

#endif
