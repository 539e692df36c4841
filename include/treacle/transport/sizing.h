// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_sizing_h
#define treacle_transport_sizing_h

#include <treacle/geometry/expression.h>
#include <treacle/scene/scene.h>
#include <treacle/surface/surface_geometry.h>

#include <optional>

namespace treacle
{
  /// How large leaves may be: along the surface, by its curvature and by how thick liquid and gaps
  /// are there, and inside the liquid, by walls and solids that ask for a level. The formula
  /// Mesh/Size counts in both. Refers to the scene.
  template <int dim>
  class Sizing
  {
  public:
    Sizing(const OctreeParameters<dim> &parameters, const Scene<dim> &scene);

    /// Does the surface have leaves of one size?
    bool
    is_uniform_at_surface() const
    {
      return prm.coarsest_at_surface() == prm.surface_level;
    }

    /// The largest leaf edge (m) at the nodes of cells that the surface cuts, from that of the surface
    /// level to that of the coarsest one; 0 at all other nodes. Collective.
    Vector
    at_surface(const State<dim> &state, const SurfaceGeometry<dim> &surface) const;

    /// The level that leaves with liquid must have at @p x: what walls and solids within @p distance
    /// (m) and the formula ask for, at least the interior level.
    unsigned int
    level_in_liquid(const Point<dim> &x, const double distance, const double time) const;

    /// Can level_in_liquid() be more than the interior level?
    bool
    asks_in_liquid() const;

  private:
    /// By curvature and formula.
    double
    by_curvature(const Mesh<dim>       &mesh,
                 const NodeVector<dim> &normal,
                 const Vector          &phi,
                 const LocalIndex       node) const;

    /// Lower the sizes at @p nodes to what thickness asks for there. Collective.
    void
    bound_by_thickness(const State<dim>              &state,
                       const SurfaceGeometry<dim>    &surface,
                       const NodeVector<dim>         &normal,
                       const std::vector<LocalIndex> &nodes,
                       Vector                        &size) const;

    const OctreeParameters<dim>          prm;
    const Scene<dim>                    &scene;
    const std::optional<Expression<dim>> largest; ///< Mesh/Size (m)
  };
} // namespace treacle

#endif
