// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/dynamics/reconstruction.h>
#include <treacle/fields/face_node.h>
#include <treacle/viscosity/least_squares.h>

namespace treacle
{
  template <int dim>
  void
  Reconstruction<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Advection");
    add_choice<Method>(prm,
                       "Reconstruction",
                       method,
                       "Node velocity from face velocity: the fit that is exact for rigid motions, "
                       "least squares at each node, or least squares in each cell and means "
                       "of these at the nodes.",
                       {{"face fitted", Method::face_fitted},
                        {"least squares", Method::least_squares},
                        {"two step", Method::two_step}});
    prm.leave_subsection();
  }

  namespace
  {
    /// There are oscillations of the node velocity that hardly any face feels. Traced to
    /// between the nodes they come back as face velocity, and inviscid flows gain energy.
    /// A strain energy this large holds them down; fitting once more to what it took from
    /// the faces gives smooth flows back to fourth order in h.
    template <int dim>
    void
    fit_smoothly(const FaceFit<dim> &fit, const double longest_step, const Vector &u, NodeVector<dim> &v)
    {
      const LiquidDomain<dim> &domain = fit.domain;
      constexpr double         weight = 0.15;
      const auto               slip   = Slip<dim>::of(domain, longest_step);
      const FaceFit<dim>       smooth = slip ? FaceFit<dim>(fit, *slip, weight) : FaceFit<dim>(fit, weight);
      smooth.solve(u, v);
      Vector again = u;
      again.zero_out_ghost_values();
      for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
        if (domain.is_liquid_face(f))
          again.local_element(f) +=
            u.local_element(f) - face_velocity(domain.mesh, v, f);
      again.update_ghost_values();
      smooth.solve(again, v);
    }
  } // namespace

  template <int dim>
  void
  Reconstruction<dim>::advance(State<dim> &state, const FaceFit<dim> &fit, const double longest_step) const
  {
    switch (prm.method)
      {
        case Method::face_fitted:
          fit_smoothly(fit, longest_step, state.u, state.v);
          break;
        case Method::two_step:
          two_step(fit.domain, state.u, state.v);
          break;
        case Method::least_squares:
          LeastSquares<dim>(fit.domain).apply(state.u, state.v);
      }
  }

  template class Reconstruction<2>;
  template class Reconstruction<3>;
} // namespace treacle
