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
  /// are there, and inside the liquid, by walls and solids that ask for a level, and jumps of the
  /// material. The formula Mesh/Size counts in both. Refers to the scene.
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

    /// The largest leaf edge (m) at the nodes of cells that the surface cuts, from that of the finest
    /// level that it may ask for to that of the coarsest one; 0 at all other nodes, and everywhere if its leaves have one size. Collective.
    Vector
    at_surface(const State<dim> &state, const SurfaceGeometry<dim> &surface) const;

    /// The level that leaves with liquid must have at @p x: what walls and solids within @p distance
    /// (m) and the formula ask for, at least the interior level.
    unsigned int
    level_in_liquid(const Point<dim> &x, const double distance, const double time) const;

    /// Are jumps of the material to have leaves of the surface level, and does it jump in a cube, by
    /// formulas and liquids at @p time? While leaves grow, as far about, and wherever a cube of half
    /// the edge is asked. What has been carried along is not known here.
    bool
    jumps_in(const Point<dim> &centre, const double edge, const double time, const bool while_growing) const;

    /// Can either ask for more than the interior level?
    bool
    asks_in_liquid(const double time) const;

  private:
    /// Can jumps_in() find any?
    bool
    may_jump(const double time) const;

    /// Mesh/Size. Throws a UserError where it is negative or no number.
    double
    size_by_formula(const Point<dim> &x, const double time) const;

    /// What curvature allows, as at_surface(). Collective.
    Vector
    by_curvature(const Mesh<dim> &mesh, const NodeVector<dim> &normal, const Vector &phi) const;

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

  /// The level that each vertex of a surface asks for, with leaves that may be larger by a factor
  /// than the sizes (m) at nodes.
  template <int dim>
  std::vector<unsigned int>
  vertex_levels(const OctreeParameters<dim> &prm,
                const Surface<dim>          &surface,
                const Vector                &size,
                const double                 factor);

  /// Would half of the cells along a surface do that has sizes? Collective.
  template <int dim>
  bool
  is_too_fine(const Mesh<dim> &mesh, const Vector &size);
} // namespace treacle

#endif
