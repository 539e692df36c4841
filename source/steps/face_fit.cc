// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/steps/face_fit.h>

namespace treacle
{
  template <int dim>
  FaceFit<dim>::FaceFit(const Parameters        &parameters,
                        const LiquidDomain<dim> &domain,
                        const double             strain_weight)
    : system(domain)
    , domain(domain)
    , parameters(parameters)
  {
    stiffness.strain.resize(domain.mesh.cell_nodes.size());
    for (LocalIndex c = 0; c < stiffness.strain.size(); ++c)
      stiffness.strain[c] = strain_weight * domain.mesh.cell_size[c] * domain.mesh.cell_size[c] *
                            domain.density[c] * domain.open_volume(c);
    assembled = system.assemble(NodeSystem<dim>::Mass::faces, stiffness);
    solver = std::make_unique<LinearSolver>(parameters.solver,
                                            "Face fit",
                                            *assembled.matrix,
                                            system.stress_free_motions(stiffness));
  }

  template <int dim>
  unsigned int
  FaceFit<dim>::solve(const Vector &u, NodeVector<dim> &v) const
  {
    const Vector       b = system.right_hand_side(system.face_momentum(u), assembled);
    Vector             x = system.unknowns(v);
    const unsigned int n = solver->solve(x, b);
    system.to_nodes(x, v);
    return n;
  }

  template class FaceFit<2>;
  template class FaceFit<3>;
} // namespace treacle
