// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/pressure/projection.h>

namespace treacle
{
  template <int dim>
  unsigned int
  Projection<dim>::advance(State<dim> &state, const double step, const Pass pass) const
  {
    const Mesh<dim> &mesh  = system.domain.mesh;
    const auto      &cells = system.cells();
    Vector           b = system.zeros(), q = system.zeros();
    system.set_walls(state.u);
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        b.local_element(i) = -system.outflow(system.domain, cells[i], state.u);
        if (pass == Pass::first)
          q.local_element(i) = state.pressure.local_element(cells[i]) * step;
      }
    // a correction is small beside what flows in and out, which has the say
    const unsigned int iterations =
      system.solve(q, b, pass == Pass::correction ? system.throughflow(state.u) : 0.);

    Vector q_cell = mesh.zeros(mesh.cells);
    system.to_cells(q, q_cell);
    system.push(q_cell, state.u);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      state.pressure.local_element(c) =
        (pass == Pass::first ? 0. : state.pressure.local_element(c)) +
        q_cell.local_element(c) / step;
    state.pressure.update_ghost_values();
    return iterations;
  }

  template <int dim>
  void
  Projection<dim>::carry_away(Vector &u, const Vector &inflow) const
  {
    Vector b = system.zeros(), q = system.zeros();
    for (unsigned int i = 0; i < system.cells().size(); ++i)
      b.local_element(i) = inflow.local_element(system.cells()[i]);
    system.solve(q, b, 0.);
    Vector q_cell = system.domain.mesh.zeros(system.domain.mesh.cells);
    system.to_cells(q, q_cell);
    system.push(q_cell, u);
  }

  template class Projection<2>;
  template class Projection<3>;
} // namespace treacle
