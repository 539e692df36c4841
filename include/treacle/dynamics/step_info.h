// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_step_info_h
#define treacle_dynamics_step_info_h

#include <treacle/dynamics/dynamics.h>

namespace treacle
{
  /// How often a step was taken again, shorter, by reason.
  struct Repetitions
  {
    unsigned int volume = 0; ///< the surface won or lost too much of it, or went too far into walls
    unsigned int motion = 0; ///< the new velocity takes the surface elsewhere
    unsigned int energy = 0; ///< the liquid had more than forces can have given it

    unsigned int
    all() const
    {
      return volume + motion + energy;
    }
  };

  /// What a step reports beside the state it leaves.
  template <int dim>
  struct StepInfo
  {
    double dt        = 0;     ///< s
    bool   rebuilt   = false; ///< the mesh is new
    double emitted   = 0;     ///< volume from emitters (m^dim)
    double drift     = 0;     ///< of the volume, relative, before it was corrected
    double excess    = 0;     ///< of kinetic or of all energy over what forces can have given, see EnergyBudget
    double wall_time = 0;     ///< s

    Repetitions repetitions;

    typename Dynamics<dim>::Info dynamics;
  };
} // namespace treacle

#endif
