// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_marker_motion_h
#define treacle_surface_marker_motion_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/parcel.h>
#include <treacle/mesh/tracer.h>

namespace treacle
{
  /// Where the markers are after dt, still on the ranks they came from, with normals
  /// turned and sheared as the surface is. Collective.
  template <int dim>
  std::vector<Marker<dim>>
  moved_markers(const State<dim> &state, const VelocityInStep<dim> &velocity, const double dt);

  /// The same of the material points of a state that carries material.
  template <int dim>
  std::vector<MaterialPoint<dim>>
  moved_material(const State<dim> &state, const VelocityInStep<dim> &velocity, const double dt);

  /// What liquid each cell of this rank has, where it is after dt, or would be if there were no walls. Collective.
  template <int dim>
  std::vector<Parcel<dim>>
  moved_parcels(const LiquidDomain<dim> &domain, const VelocityInStep<dim> &velocity, const double dt);
} // namespace treacle

#endif
