// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_correction_h
#define treacle_surface_marker_correction_h

#include <treacle/fields/mesh_data.h>
#include <treacle/fields/state.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/near_markers.h>
#include <treacle/surface/smooth_level_set.h>

#include <deal.II/base/array_view.h>

#include <algorithm>
#include <optional>

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

    /// Where markers that are still those of the state were found, if any was looked for.
    Guesses
    cells(const State<dim> &state) const
    {
      return state.markers.size() == guesses.size() ? guesses : Guesses();
    }

    /// Between nodes a P1 function is above the distance from a surface that is round or thin, and below it in a crease: a thread
    /// of 0.9, 1.3, 1.8 leaves would have 37, 73, 87 % of its volume, by where it lies. Change phi of the same state about parts
    /// as thin, and edges and creases as sharp as that, so that it is the distance from the markers in the mean over the middles
    /// of edges. Between two sides, of a sheet or of a gap, which is to close, and near solids it is not raised. Collective.
    void
    fill_thin_parts(State<dim> &state, const MeshData<dim> &data);

    /// Elsewhere too a P1 function shows chords, so that a sphere of 2 or 3.2 leaves' radius would have 94 or 97.6 % of its volume:
    /// change phi of the same state, from which @p level_set is, about what is round so that it has its volume in the mean over the
    /// cells around each node. As far as markers take it back when they correct phi next, lest it add up. Collective.
    void
    fill_chords(State<dim> &state, const MeshData<dim> &data, const SmoothLevelSet<dim> &level_set);

  private:
    /// Markers around an owned node, once they are found.
    struct AroundNode
    {
      unsigned int       begin = invalid, end = invalid; ///< of near
      const Marker<dim> *nearest = nullptr;
      bool is_thin   = false; ///< do they face so differently that a thin part is near, or an edge or a crease?
      bool has_sides = false; ///< do some face away from the nearest, or towards it?
    };

    /// The distance from the markers in the middle of an edge from a node.
    struct MiddleOfEdge
    {
      LocalIndex   other; ///< node
      unsigned int n_cells;
      double       distance;
    };

    /// An owned node near a thin part or an edge, and the edges from it that the surface cuts.
    struct ThinNode
    {
      LocalIndex                node;
      double                    size;     ///< of leaves around it
      bool                      may_rise; ///< phi
      unsigned int              n_cells;  ///< of all its edges
      std::vector<MiddleOfEdge> middles;
      double                    lowered;  ///< by so much, in all

      std::optional<double>
      middle_to(const LocalIndex other) const
      {
        const auto middle =
          std::find_if(middles.begin(), middles.end(), [&](const MiddleOfEdge &m) { return m.other == other; });
        return middle == middles.end() ? std::nullopt : std::make_optional(middle->distance);
      }
    };

    /// Those around a node, with leaves of a size (m) beside it.
    const AroundNode &
    around(const LocalIndex node, const double size);

    /// All that AroundNode says.
    ArrayView<const NearMarker<dim> *const>
    all(const AroundNode &about) const
    {
      return {near.data() + about.begin, about.end - about.begin};
    }

    /// The distance in the middle of an edge, where leaves have a @p size; none if the surface does not cut it, or markers do not
    /// know the middle.
    std::optional<double>
    in_middle(const Vector &phi, const LocalIndex node, const LocalIndex other, const double size);

    std::vector<ThinNode>
    thin_nodes(const State<dim> &state, const MeshData<dim> &data);

    const Mesh<dim>                     &mesh;
    const std::vector<Point<dim>>        position;
    Guesses                              guesses; ///< for the positions
    MarkersWithinLeaves<dim>             markers;
    std::vector<const NearMarker<dim> *> near; ///< of one node after another
    std::vector<AroundNode>              of_node;
  };
} // namespace treacle

#endif
