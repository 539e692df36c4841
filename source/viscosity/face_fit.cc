// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/viscosity/face_fit.h>

namespace treacle
{
  template <int dim>
  FaceFit<dim>::FaceFit(const Parameters &parameters, const LiquidDomain<dim> &domain)
    : FaceFit(parameters, std::make_shared<const NodeSystem<dim>>(domain), 1e-2)
  {}

  template <int dim>
  FaceFit<dim>::FaceFit(const FaceFit &other, const double strain_weight)
    : FaceFit(other.prm, other.shared_system, strain_weight)
  {}

  template <int dim>
  FaceFit<dim>::FaceFit(const FaceFit &other, const Slip<dim> &slip, const double strain_weight)
    : FaceFit(other.prm, std::make_shared<const NodeSystem<dim>>(*slip.domain), strain_weight)
  {
    stiffness.springs = slip.springs;
  }

  template <int dim>
  FaceFit<dim>::FaceFit(const Parameters                             &parameters,
                        const std::shared_ptr<const NodeSystem<dim>> &system,
                        const double                                  strain_weight)
    : prm(parameters)
    , shared_system(system)
    , system(*shared_system)
    , domain(system->domain)
  {
    stiffness.strain.resize(domain.mesh.cell_nodes.size());
    for (LocalIndex c = 0; c < stiffness.strain.size(); ++c)
      stiffness.strain[c] = strain_weight * domain.mesh.cell_size[c] * domain.mesh.cell_size[c] *
                            domain.density[c] * domain.open_volume(c);
  }

  template <int dim>
  unsigned int
  FaceFit<dim>::solve(const Vector &u, NodeVector<dim> &v) const
  {
    if (!solver)
      {
        assembled = system.assemble(NodeSystem<dim>::Mass::faces, stiffness);
        solver    = std::make_unique<LinearSolver>(
          prm.solver, "Face fit", *assembled.matrix, [this] {
            return system.stress_free_motions(stiffness);
          });
      }
    const Vector       b = system.right_hand_side(system.face_momentum(u), assembled);
    Vector             x = system.unknowns(v);
    const unsigned int n = solver->solve(x, b);
    system.to_nodes(x, v);
    return n;
  }

  template class FaceFit<2>;
  template class FaceFit<3>;
} // namespace treacle
