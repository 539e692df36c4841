// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/dynamics/step_switches.h>

namespace treacle
{
  void
  StepSwitches::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Steps");
    prm.add_parameter("Surface",
                      surface,
                      "Does the surface move? If not, surface, markers and mesh stay as they are: "
                      "a body of fixed shape, for exact cases. Solids move all the same.");
    prm.add_parameter("Advection",
                      advection,
                      "Are velocity and material carried along? If not they stay where they are, "
                      "and Surface must be false.");
    prm.add_parameter("Viscosity", viscosity, "Is there a viscous step?");
    prm.add_parameter("Pressure",
                      pressure,
                      "Is the velocity made free of divergence? If not, the pressure is zero.");
    prm.leave_subsection();
  }

  template <int dim>
  void
  StepSwitches::check(const Scene<dim> &scene) const
  {
    require(advection || !surface,
            "Steps/Advection is false, but Steps/Surface is true: liquid that moves carries its "
            "velocity along; set Steps/Surface = false too.");
    if (!surface)
      for (const Emitter<dim> &emitter : scene.emitters())
        require(emitter.start_time <= 0,
                emitter.where + "/Start time is positive, but with Steps/Surface = false no liquid "
                                "appears: set one of them to its default.");
  }

  template void
  StepSwitches::check(const Scene<2> &) const;
  template void
  StepSwitches::check(const Scene<3> &) const;
} // namespace treacle
