// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_remesh_h
#define treacle_transport_remesh_h

#include <treacle/mesh/band.h>
#include <treacle/transport/advection.h>

namespace treacle
{
  /// The mesh for the surface after dt: the old one while its leaves are as fine as surface, velocity, walls,
  /// solids and formula ask for, and not much finer, else a new one around it; from a file always the old one.
  /// @p next is where the surface's vertices and @p markers those after dt. Emitters that have not stopped are
  /// surrounded by finest leaves. Collective.
  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  mesh_for_next_surface(const State<dim>               &state,
                        const LiquidDomain<dim>        &domain,
                        const SurfaceGeometry<dim>     &surface,
                        const Advection<dim>           &advection,
                        const std::vector<Point<dim>>  &next,
                        const std::vector<Marker<dim>> &markers,
                        const double                    dt);
} // namespace treacle

#endif
