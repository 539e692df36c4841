// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/steps/extrapolation.h>
#include <treacle/steps/reconstruction.h>

namespace treacle
{
  template <int dim>
  void
  Reconstruction<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Advection");
    prm.add_parameter("Reconstruction",
                      method,
                      "Node velocity from face velocity: the fit that is exact for rigid motions, "
                      "or least squares at each node.",
                      Patterns::Selection("face fitted|least squares"));
    prm.leave_subsection();
  }

  template <int dim>
  void
  Reconstruction<dim>::advance(State<dim> &state, const FaceFit<dim> &fit, const double reach) const
  {
    if (prm.method == "face fitted")
      fit.solve(state.u, state.v);
    else
      least_squares(fit.domain, state.u, state.v);
    extrapolate(state, fit.domain, reach);
  }

  template class Reconstruction<2>;
  template class Reconstruction<3>;
} // namespace treacle
