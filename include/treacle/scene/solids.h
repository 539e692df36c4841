// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_solids_h
#define treacle_scene_solids_h

#include <treacle/scene/solid.h>

namespace treacle
{
  /// The solids of a scene and their union.
  template <int dim>
  class Solids
  {
  public:
    using Parameters = std::vector<typename Solid<dim>::Parameters>;

    /// Collective, for the first rank reads files.
    Solids(const Parameters &parameters, const BoundingBox<dim> &box, const MPI_Comm &comm);

    bool
    has_solids() const;

    unsigned int
    n_solids() const;

    /// Signed distance to the union of the solids, positive outside
    /// them (where liquid may be); a large number if there is none.
    double
    solid_distance(const Point<dim> &x, const double t) const;

    /// The same where a wall is nearer than @p reach (m); else a number of its sign, no nearer than that, no farther than it is, sooner.
    double
    solid_distance_within(const Point<dim> &x, const double reach, const double t) const;

    bool
    has_moving_solids() const;

    /// The distance to the solids at rest alone, and to the others.
    double
    resting_solid_distance(const Point<dim> &x) const;
    double
    moving_solid_distance(const Point<dim> &x, const double t) const;

    /// To solid k.
    double
    solid_distance(const unsigned int k, const Point<dim> &x, const double t) const;

    /// Of the nearest solid (m/s), or of solid k.
    Tensor<1, dim>
    solid_velocity(const Point<dim> &x, const double t) const;
    Tensor<1, dim>
    solid_velocity(const unsigned int k, const Point<dim> &x, const double t) const;

    /// The solid (from 0) of smallest distance; there is at least one.
    unsigned int
    nearest_solid(const Point<dim> &x, const double t) const;

    /// The largest level that solids ask for whose walls are closer than @p distance (m); 0: none.
    unsigned int
    level_near_solids(const Point<dim> &x, const double distance, const double t) const;

    /// Does any solid ask for a level?
    bool
    solids_ask_for_levels() const;

    /// Centre of rotation of solid k (m).
    Point<dim>
    solid_centre(const unsigned int k, const double t) const;

    /// Throws a UserError if the motion of one is not finite: for all ranks together, before some of them ask where solids are at t.
    void
    check_solids(const double t) const;

  private:
    /// Of one at least, with its distance (m).
    std::pair<const Solid<dim> *, double>
    nearest_of(const Point<dim> &x, const double t) const;

    /// To those that move, or those that do not.
    double
    distance_to(const bool moving, const Point<dim> &x, const double t) const;

    std::vector<Solid<dim>> solids;
  };
} // namespace treacle

#endif
