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
    double wall_time = 0;     ///< s

    unsigned int repetitions = 0; ///< with half the size
    unsigned int surprises   = 0; ///< those for a velocity that came unexpected, not for the drift

    typename Dynamics<dim>::Info dynamics;
  };
} // namespace treacle

#endif
