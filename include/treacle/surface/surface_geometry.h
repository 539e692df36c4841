// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_surface_geometry_h
#define treacle_surface_surface_geometry_h

#include <treacle/surface/smooth_level_set.h>
#include <treacle/surface/surface_distance.h>

#include <optional>

namespace treacle
{
  /// The surface phi = 0, and what is computed once for each: its facets, the search for
  /// the nearest of them, gradients of phi at the nodes.
  template <int dim>
  class SurfaceGeometry
  {
  public:
    /// @p phi is copied. Collective.
    SurfaceGeometry(std::shared_ptr<const Mesh<dim>> mesh, const Vector &phi)
      : own_mesh(std::move(mesh))
      , own_phi(phi)
      , mesh(*own_mesh)
      , level_set(*own_mesh, with_ghosts(own_phi))
      , facets(extract_surface(*own_mesh, own_phi))
    {}

    SurfaceGeometry(const SurfaceGeometry &) = delete;

  private:
    static const Vector &
    with_ghosts(const Vector &v)
    {
      v.update_ghost_values();
      return v;
    }

    const std::shared_ptr<const Mesh<dim>> own_mesh;
    const Vector                           own_phi;

  public:
    const Mesh<dim>          &mesh;
    const SmoothLevelSet<dim> level_set;
    const Surface<dim>        facets; ///< of this rank

    /// Within @p reach (m). Collective.
    const SurfaceDistance<dim> &
    distance(const double reach) const
    {
      if (!search || search->reach != reach)
        search.emplace(mesh, facets, reach);
      return *search;
    }

  private:
    mutable std::optional<const SurfaceDistance<dim>> search;
  };
} // namespace treacle

#endif
