// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/viscosity/auxiliary_space.h>
#include <treacle/viscosity/hybrid.h>
#include <treacle/viscosity/viscosity.h>

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
          const typename NodeSystem<dim>::Stiffness &stiffness,
          const std::vector<Tensor<1, dim>>         &momentum,
          const bool                                 flip,
          const LinearSolver::Parameters            &prm)
    {
      const LinearSolver solver(prm, "Viscosity", *assembled.matrix, [&] {
        return system.stress_free_motions(stiffness);
      });
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

    /// Conjugate gradients at the faces, with the diagonal or nothing.
    template <int dim>
    unsigned int
    solve_faces(const FaceCoupled<dim> &face_coupled, LinearSolver::Parameters prm, Vector &u)
    {
      LinearSolver::Operator preconditioner = [](Vector &z, const Vector &r) { z = r; };
      if (prm.preconditioner != LinearSolver::Preconditioner::none)
        {
          prm.preconditioner = LinearSolver::Preconditioner::jacobi;
          preconditioner = [d = face_coupled.inverse_diagonal()](Vector &z, const Vector &r) {
            z = r;
            z.scale(d);
          };
        }
      const auto matrix = [&](Vector &y, const Vector &x) { face_coupled.vmult(y, x); };
      const Vector b    = face_coupled.right_hand_side(u);
      return LinearSolver(prm, "Viscosity", matrix, preconditioner).solve(u, b);
    }
  } // namespace

  template <int dim>
  const Choice<typename Viscosity<dim>::Mapping> Viscosity<dim>::mappings{
    {"face coupled", Mapping::face_coupled},
    {"face fitted FLIP", Mapping::face_fitted_flip},
    {"face fitted PIC", Mapping::face_fitted_pic},
    {"hybrid", Mapping::hybrid},
    {"node FLIP", Mapping::node_flip},
    {"node PIC", Mapping::node_pic}};

  template <int dim>
  void
  Viscosity<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Viscosity");
    add_choice(
      prm,
      "Mapping",
      mapping,
      "How viscosity is carried between face and node velocity: by a fit of the "
      "node velocity to the faces, exact for rigid motions, or by least squares at "
      "each node; the faces receive the change (FLIP) or the value (PIC). Face "
      "coupled: the least squares are part of the implicit system, whose unknowns "
      "are the faces. Hybrid: the nodes drag the faces along in one implicit system, exact for "
      "rigid motions too.",
      mappings);
    add_choice<StressModel>(
      prm,
      "Stress model",
      stress_model,
      "Full: the stress mu (grad u + grad u^T). Laplacian: div(mu grad u) for "
      "each component, which damps rotation where the liquid is free; for comparison.",
      {{"full", StressModel::full}, {"laplacian", StressModel::laplacian}});
    add_choice<ElementWeighting>(prm,
                                 "Element weighting",
                                 element_weighting,
                                 "Whether the stiffness of a cell that the surface cuts is scaled "
                                 "by its liquid fraction or kept whole.",
                                 {{"liquid fraction", ElementWeighting::liquid_fraction},
                                  {"full", ElementWeighting::full}});
    prm.leave_subsection();
    solver.add_parameters(prm,
                          "Viscosity",
                          " The mapping face coupled takes amg as a preconditioner of MINRES at the "
                          "nodes, the others but none as the diagonal.");
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance(State<dim>         &state,
                          const FaceFit<dim> &fit,
                          const double        step,
                          Reactions<dim>     *reactions) const
  {
    switch (prm.mapping)
      {
        case Mapping::hybrid:
          return advance_hybrid(state, fit, step, reactions);
        case Mapping::face_coupled:
          return advance_face_coupled(state, fit, step, reactions);
        case Mapping::node_flip:
        case Mapping::node_pic:
          return advance_nodes(state, fit, step, reactions);
        default:
          return advance_face_fitted(state, fit, step, reactions);
      }
  }

  template <int dim>
  typename NodeSystem<dim>::Stiffness
  Viscosity<dim>::stiffness(const LiquidDomain<dim> &domain, const double step) const
  {
    const bool                          whole = prm.element_weighting == ElementWeighting::full;
    typename NodeSystem<dim>::Stiffness result;
    std::vector<double> &weight = prm.stress_model == StressModel::full ? result.strain : result.gradient;
    weight.resize(domain.viscosity.size());
    for (LocalIndex c = 0; c < weight.size(); ++c)
      if (domain.liquid_volume[c] > 0)
        weight[c] =
          step * domain.viscosity[c] * (whole ? domain.open_volume(c) : domain.liquid_volume[c]);
    if (!result.strain.empty())
      result.kinks = Kinks<dim>(domain, result.strain);
    return result;
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance_face_fitted(State<dim>         &state,
                                      const FaceFit<dim> &fit,
                                      const double        step,
                                      Reactions<dim>     *reactions) const
  {
    const LiquidDomain<dim> &domain = fit.domain;
    const bool               flip   = prm.mapping == Mapping::face_fitted_flip;
    if (flip)
      fit.solve(state.u, state.v);
    const Vector          old_u = state.u;
    const NodeVector<dim> old_v = state.v;
    old_u.update_ghost_values();
    old_v.update_ghost_values();

    auto stiffness = this->stiffness(domain, step);
    stiffness.strain.resize(domain.viscosity.size());
    for (LocalIndex c = 0; c < stiffness.strain.size(); ++c)
      stiffness.strain[c] += fit.regularization()[c];
    const unsigned int iterations =
      solve(state,
            fit.system,
            fit.system.assemble(NodeSystem<dim>::Mass::faces, stiffness),
            stiffness,
            fit.system.face_momentum(state.u),
            flip,
            prm.solver);
    if (reactions != nullptr)
      {
        reactions->add_stress(stiffness, state.v);
        if (flip)
          reactions->add_stress({fit.regularization(), {}, {}}, old_v, -1);
        reactions->add_inertia(fit.system, old_u, state.u);
      }
    return iterations;
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance_hybrid(State<dim>         &state,
                                 const FaceFit<dim> &fit,
                                 const double        step,
                                 Reactions<dim>     *reactions) const
  {
    const auto         stiffness = this->stiffness(fit.domain, step);
    const Hybrid<dim>  hybrid(fit.system, stiffness, step, Hybrid<dim>::Faces::all);
    const LinearSolver solver(prm.solver,
                              "Viscosity",
                              *hybrid.stiff.matrix,
                              [&] { return fit.system.stress_free_motions(stiffness); });
    Vector             x          = fit.system.unknowns(state.v);
    const unsigned int iterations = solver.solve(x, hybrid.right_hand_side(state.u, state.v));
    fit.system.to_nodes(x, state.v);
    hybrid.drag_faces(state, stiffness, reactions);
    return iterations;
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance_nodes(State<dim>         &state,
                                const FaceFit<dim> &fit,
                                const double        step,
                                Reactions<dim>     *reactions) const
  {
    const LiquidDomain<dim> &domain = fit.domain;
    LeastSquares<dim>(domain).apply(state.u, state.v);
    std::vector<Tensor<1, dim>> momentum(domain.node_mass.size());
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      momentum[node] = domain.node_mass[node] * state.v.value(node);

    const auto         stiffness = this->stiffness(domain, step);
    const unsigned int iterations =
      solve(state,
            fit.system,
            fit.system.assemble(NodeSystem<dim>::Mass::nodes, stiffness),
            stiffness,
            momentum,
            prm.mapping == Mapping::node_flip,
            prm.solver);
    if (reactions != nullptr)
      reactions->add_stress(stiffness, state.v);
    return iterations;
  }

  template <int dim>
  unsigned int
  Viscosity<dim>::advance_face_coupled(State<dim>         &state,
                                       const FaceFit<dim> &fit,
                                       const double        step,
                                       Reactions<dim>     *reactions) const
  {
    const LiquidDomain<dim> &domain    = fit.domain;
    const auto               stiffness = this->stiffness(domain, step);
    const FaceCoupled<dim>   face_coupled(fit.system, stiffness);

    Vector u = domain.mesh.zeros(domain.mesh.faces);
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        u.local_element(f) = state.u.local_element(f);
    const unsigned int iterations =
      prm.solver.preconditioner == LinearSolver::Preconditioner::amg ?
        AuxiliarySpace<dim>(face_coupled, stiffness, prm.solver).solve(u) :
        solve_faces(face_coupled, prm.solver, u);

    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        state.u.local_element(f) = u.local_element(f);
    state.u.update_ghost_values();
    face_coupled.H.apply(state.u, state.v);
    if (reactions != nullptr)
      reactions->add_stress(stiffness, state.v);
    return iterations;
  }

  template class Viscosity<2>;
  template class Viscosity<3>;
} // namespace treacle
