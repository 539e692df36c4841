// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_free_fall_h
#define treacle_transport_free_fall_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/state.h>
#include <treacle/mesh/tracer.h>

namespace treacle
{
  /// Crumbs, threads and films thinner than a leaf: pressure hardly acts on them, so they fall, and what is read where
  /// they were a step before is continued from whatever liquid is nearest now, and does not tell how fast they were.
  template <int dim>
  class FreeFall
  {
  public:
    /// @p domain and the vectors of @p state, with ghosts, must outlive this object. Collective.
    FreeFall(const State<dim> &state, const LiquidDomain<dim> &domain);

    /// Set the change (m/s, dim a point) of the velocity within @p dt (s) of what comes from points @p x in such parts,
    /// or the air about them. Guesses as the Tracer's. Throws on all ranks alike where gravity cannot be had. Collective.
    void
    set_change(std::vector<double>           &change,
               const std::vector<Point<dim>> &x,
               Guesses                       &cells,
               const double                   dt) const;

  private:
    const LiquidDomain<dim> &domain;
    const double             time;
    /// 0 at nodes about such parts: those where velocity is prescribed, and liquid half a leaf deep, are more than two
    /// cells away.
    Vector held;
  };
} // namespace treacle

#endif
