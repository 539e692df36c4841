// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/viscosity/face_coupled.h>

namespace treacle
{
  template <int dim>
  FaceCoupled<dim>::FaceCoupled(const NodeSystem<dim>                     &system,
                                const typename NodeSystem<dim>::Stiffness &stiffness)
    : system(system)
    , H(system.domain, LeastSquares<dim>::Weight::mass)
    , mass(system.domain.mesh.faces)
    , inverse_mass_of_faces(mass)
    , assembled(system.assemble(NodeSystem<dim>::Mass::none, stiffness))
    , v(assembled.shift)
    , force(assembled.shift)
  {
    const LiquidDomain<dim> &domain = system.domain;
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        {
          mass.local_element(f)                  = domain.face_mass[f];
          inverse_mass_of_faces.local_element(f) = 1 / domain.face_mass[f];
        }
  }

  template <int dim>
  void
  FaceCoupled<dim>::vmult(Vector &y, const Vector &u) const
  {
    u.update_ghost_values();
    H.vmult(v, u);
    u.zero_out_ghost_values();
    assembled.matrix->vmult(force, v);
    H.Tvmult(y, force);
    for (LocalIndex f = 0; f < mass.locally_owned_size(); ++f)
      y.local_element(f) += mass.local_element(f) * u.local_element(f);
  }

  template <int dim>
  Vector
  FaceCoupled<dim>::right_hand_side(const Vector &u) const
  {
    Vector b(mass);
    H.Tvmult(b, assembled.shift);
    for (LocalIndex f = 0; f < mass.locally_owned_size(); ++f)
      b.local_element(f) += mass.local_element(f) * u.local_element(f);
    return b;
  }

  template <int dim>
  Vector
  FaceCoupled<dim>::inverse_diagonal() const
  {
    const LiquidDomain<dim>    &domain = system.domain;
    const auto                 &nodes  = H.nodes();
    const IndexSet              rows   = assembled.matrix->locally_owned_range_indices();
    const GlobalIndex           first  = rows.n_elements() > 0 ? rows.nth_index_in_set(0) : 0;
    std::vector<Tensor<2, dim>> blocks(nodes.size());
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          if ((domain.constrained[nodes[i]] >> a & 1) == 0 &&
              (domain.constrained[nodes[i]] >> b & 1) == 0)
            blocks[i][a][b] = assembled.matrix->el(first + dim * i + a, first + dim * i + b);
    Vector result = H.diagonal(blocks);
    result += mass;
    for (LocalIndex f = 0; f < mass.locally_owned_size(); ++f)
      if (mass.local_element(f) > 0)
        result.local_element(f) = 1 / result.local_element(f);
    return result;
  }

  template class FaceCoupled<2>;
  template class FaceCoupled<3>;
} // namespace treacle
