// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_films_h
#define treacle_surface_films_h

#include <treacle/fields/state.h>
#include <treacle/surface/near_markers.h>

#include <map>
#include <optional>

namespace treacle
{
  /// Liquid between two sides, of which P1 functions show a net, or nothing, where it is thinner than a leaf: from the markers, finer
  /// than phi at nodes.
  template <int dim>
  class Films
  {
  public:
    /// Collective.
    explicit Films(const State<dim> &state);

    /// phi (m) at a node of this rank's cells: in a film the distance from the markers of its sides.
    double
    phi_at(const LocalIndex node) const
    {
      return phi.local_element(node);
    }

    /// Are markers of two sides near a node of this rank's cells?
    bool
    is_near(const LocalIndex node) const
    {
      return near.local_element(node) > 0;
    }

    static constexpr unsigned int n_parts = 4; ///< of an edge

    /// What is known of an edge between nodes, from the first to the second.
    struct Edge
    {
      std::array<double, n_parts + 1> phi{};
      std::array<bool, n_parts + 1>   is_cut{}; ///< does that value change where phi changes its sign?
    };

    /// Of one of this rank's cells.
    const Edge &
    edge(const LocalIndex first, const LocalIndex second);

  private:
    std::optional<double>
    phi_in_film(const Point<dim> &x, const double old, const double size) const;

    void
    measure(Edge &edge, const LocalIndex first, const LocalIndex second) const;

    const Mesh<dim>                                &mesh;
    const MarkersWithinLeaves<dim>                  markers;
    Vector                                          phi, near; ///< with ghosts; near is 1 or 0
    std::map<std::pair<LocalIndex, LocalIndex>, Edge> edges;   ///< near films
  };
} // namespace treacle

#endif
