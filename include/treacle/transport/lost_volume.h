// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_lost_volume_h
#define treacle_transport_lost_volume_h

#include <treacle/fields/parcel.h>
#include <treacle/scene/scene.h>
#include <treacle/surface/liquid.h>

namespace treacle
{
  /// Volume that a step has pushed into a wall, a solid or other liquid.
  template <int dim>
  struct LostVolume
  {
    Point<dim>     entry;   ///< where the wall's surface is crossed, or in the liquid (m)
    Tensor<1, dim> outward; ///< unit, out of the wall or the other liquid
    double         volume;  ///< m^dim
  };

  /// The surface of a mesh before a step, of this rank, and where its vertices are afterwards (m).
  template <int dim>
  struct MovedSurface
  {
    const Mesh<dim>               &mesh;
    const Surface<dim>            &before;
    const std::vector<Point<dim>> &after;
  };

  /// Between the places of the surface's vertices before and after a step; what was in a solid before
  /// does not count. Sides of the box are walls too. Throws a UserError on all ranks. Collective.
  template <int dim>
  std::vector<LostVolume<dim>>
  lost_in_walls(const Scene<dim>        &scene,
                const MovedSurface<dim> &surface,
                const double             time_before,
                const double             time_after);

  /// Of the facets that a step moves more than half a cell into liquid, as where a drop falls into a pool, what they sweep: what is
  /// lost there, and the air that was before it. @p state is that after the step. Throws a UserError on all ranks. Collective.
  template <int dim>
  std::vector<LostVolume<dim>>
  lost_in_liquid(const Scene<dim> &scene, const MovedSurface<dim> &surface, const State<dim> &state);

  /// What facets move over, out of the liquid, over all ranks (m^dim). Collective.
  template <int dim>
  double
  swept_outwards(const MovedSurface<dim> &surface);

  /// A @p volume (m^dim) of what was lost, @p way (m) in front of where that was. Collective.
  template <int dim>
  std::vector<Parcel<dim>>
  parcels_of(const std::vector<LostVolume<dim>> &lost, const double volume, const double way, const MPI_Comm &comm);

  /// The same by the pressure cells there, in front of walls within two leaves; what finds none is
  /// left out. Collective.
  template <int dim>
  Vector
  lost_by_cells(const LiquidDomain<dim> &domain, const std::vector<LostVolume<dim>> &lost);
} // namespace treacle

#endif
