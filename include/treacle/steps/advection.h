// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_steps_advection_h
#define treacle_steps_advection_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/steps/smooth_level_set.h>

namespace treacle
{
  /// Semi-Lagrangian advection from the old state into a new or the same mesh.
  template <int dim>
  class Advection
  {
  public:
    Advection(const State<dim> &old, const LiquidDomain<dim> &domain);

    /// The state at old.time + dt: phi, and u within @p reach (m) of the liquid.
    State<dim>
    advance(std::shared_ptr<const Mesh<dim>> mesh, const double dt, const double reach) const;

    /// Where points of the surface are after dt.
    std::vector<Point<dim>>
    move_surface(const std::vector<Point<dim>> &x, const double dt) const;

    /// The markers after dt, still on the ranks they came from.
    std::vector<Marker<dim>>
    move_markers(const double dt) const;

    /// phi at points of the new time.
    std::vector<double>
    level_set(const std::vector<Point<dim>> &x, const double dt) const;

  private:
    const State<dim> &old;
    /// What moves the surface: the node velocity, but at walls and in solids that
    /// of the nodes beside them. With the wall's own velocity a film of air
    /// would remain under all that falls on it, for a P1 velocity vanishes there.
    NodeVector<dim>     surface_velocity;
    SmoothLevelSet<dim> phi;
  };
} // namespace treacle

#endif
