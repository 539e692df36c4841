// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_step_info_h
#define treacle_dynamics_step_info_h

#include <treacle/dynamics/dynamics.h>

namespace treacle
{
  /// What a step reports beside the state it leaves.
  template <int dim>
  struct StepInfo
  {
    double dt        = 0;     ///< s
    bool   rebuilt   = false; ///< the mesh is new
    double emitted   = 0;     ///< volume from emitters (m^dim)
    double drift     = 0;     ///< of the volume, relative, before it was corrected

    unsigned int repetitions = 0; ///< with half the size, for the drift was too large
    double wall_time = 0;     ///< s

    typename Dynamics<dim>::Info dynamics;
  };
} // namespace treacle

#endif
