// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/steps/viscosity.h>

namespace treacle
{
  namespace
  {
    /// Solve for the node velocity and set state.v to it; add to each liquid face
    /// what P makes of the change (FLIP), or set it to P v (PIC).
    template <int dim>
    unsigned int
    solve(State<dim>                                &state,
          const NodeSystem<dim>                     &system,
          const typename NodeSystem<dim>::Assembled &assembled,
          const std::vector<Tensor<1, dim>>         &momentum,
          const bool                                 flip,
          const LinearSolver::Parameters            &prm)
    {
      const LinearSolver solver(prm, "Viscosity", *assembled.matrix, system.rigid_motions());
      Vector             x          = system.unknowns(state.v);
      const unsigned int iterations = solver.solve(x, system.right_hand_side(momentum, assembled));
      const NodeVector<dim> old     = state.v;
      old.update_ghost_values();
      system.to_nodes(x, state.v);

      const LiquidDomain<dim> &domain = system.domain;
      for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
        if (domain.is_liquid_face(f))
          {
            double &u = state.u.local_element(f);
            u         = face_velocity(domain.mesh, state.v, f) +
                (flip ? u - face_velocity(domain.mesh, old, f) : 0.);
          }
      state.u.update_ghost_values();
      return iterations;
    }
  } // namespace

  template <int dim>
  void
  Viscosity<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Viscosity");
    prm.add_parameter(
      "Mapping",
      mapping,
      "How viscosity is carried between face and node velocity: by a fit of the "
      "node velocity to the faces, exact for rigid motions, or by least squares at "
      "each node; the faces receive the change (FLIP) or the value (PIC).",
      Patterns::Selection("face fitted FLIP|face fitted PIC|node FLIP|node PIC"));
    prm.add_parameter("Element weighting",
                      element_weighting,
                      "Whether the stiffness of a cell that the surface cuts is scaled by its "
                      "liquid fraction or kept whole.",
                      Patterns::Selection("liquid fraction|full"));
    prm.leave_subsection();
    solver.add_parameters(prm, "Viscosity");
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance(State<dim> &state, const FaceFit<dim> &fit, const double dt) const
  {
    return prm.mapping.rfind("node", 0) == 0 ? advance_nodes(state, fit, dt) :
                                               advance_face_fitted(state, fit, dt);
  }

  template <int dim>
  std::vector<double>
  Viscosity<dim>::strain_coefficient(const LiquidDomain<dim> &domain, const double dt) const
  {
    const bool          full = prm.element_weighting == "full";
    std::vector<double> result(domain.viscosity.size());
    for (LocalIndex c = 0; c < result.size(); ++c)
      if (domain.liquid_volume[c] > 0)
        result[c] = dt * domain.viscosity[c] *
                    (full ? domain.mesh.cell_volume[c] : domain.liquid_volume[c]);
    return result;
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance_face_fitted(State<dim>         &state,
                                      const FaceFit<dim> &fit,
                                      const double        dt) const
  {
    const LiquidDomain<dim> &domain = fit.domain;
    const bool               flip   = prm.mapping == "face fitted FLIP";
    if (flip)
      fit.solve(state.u, state.v);

    std::vector<double> coefficient = strain_coefficient(domain, dt);
    for (LocalIndex c = 0; c < coefficient.size(); ++c)
      coefficient[c] += fit.regularization()[c];
    return solve(state,
                 fit.system,
                 fit.system.assemble(NodeSystem<dim>::Mass::faces, coefficient),
                 fit.system.face_momentum(state.u),
                 flip,
                 prm.solver);
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance_nodes(State<dim> &state, const FaceFit<dim> &fit, const double dt) const
  {
    const LiquidDomain<dim> &domain = fit.domain;
    least_squares(domain, state.u, state.v);
    std::vector<Tensor<1, dim>> momentum(domain.node_mass.size());
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      momentum[node] = domain.node_mass[node] * state.v.value(node);

    return solve(state,
                 fit.system,
                 fit.system.assemble(NodeSystem<dim>::Mass::nodes, strain_coefficient(domain, dt)),
                 momentum,
                 prm.mapping == "node FLIP",
                 prm.solver);
  }

  template class Viscosity<2>;
  template class Viscosity<3>;
} // namespace treacle
