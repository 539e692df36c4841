// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/least_squares.h>
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
                      "least squares at each node, or least squares in each cell and means "
                      "of these at the nodes.",
                      Patterns::Selection("face fitted|least squares|two step"));
    prm.leave_subsection();
  }

  template <int dim>
  void
  Reconstruction<dim>::advance(State<dim> &state, const FaceFit<dim> &fit, const double reach) const
  {
    if (prm.method == "face fitted")
      fit.solve(state.u, state.v);
    else if (prm.method == "two step")
      two_step(fit.domain, state.u, state.v);
    else
      LeastSquares<dim>(fit.domain).apply(state.u, state.v);
    extrapolate(state, fit.domain, reach);
  }

  template class Reconstruction<2>;
  template class Reconstruction<3>;
} // namespace treacle
