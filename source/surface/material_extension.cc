// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/surface/material_extension.h>

namespace treacle
{
  template <int dim>
  void
  set_initial_material(State<dim> &state, const Scene<dim> &scene)
  {
    const Mesh<dim> &mesh = *state.mesh;
    state.material.emplace(mesh.nodes);
    Vector &density = state.material->density, &viscosity = state.material->viscosity;
    std::string error;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (state.phi.local_element(node) < 0)
        keep_error(error, [&] {
          const Point<dim>    &x         = mesh.node_position[node];
          const Material<dim> &material  = scene.initial_material(x);
          density.local_element(node)    = material.density(x, 0.);
          viscosity.local_element(node)  = material.viscosity(x, 0.);
        });
    throw_first(mesh.communicator(), error);
    state.material->update_ghost_values();
  }

  template <int dim>
  void
  extend_material(State<dim> &state, const unsigned int n_layers)
  {
    const Mesh<dim> &mesh  = *state.mesh;
    Vector           known = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      known.local_element(node) = state.phi.local_element(node) < 0;
    known.update_ghost_values();
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        const Vector was_known = known;
        was_known.update_ghost_values();
        const CarriedMaterial old = *state.material;
        old.update_ghost_values();
        known.zero_out_ghost_values();
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            if (was_known.local_element(node) > 0)
              continue;
            double density = 0, viscosity = 0;
            unsigned int n = 0;
            for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
              for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
                if (was_known.local_element(other) > 0)
                  {
                    density += old.density.local_element(other);
                    viscosity += old.viscosity.local_element(other);
                    ++n;
                  }
            if (n == 0)
              continue;
            state.material->density.local_element(node)   = density / n;
            state.material->viscosity.local_element(node) = viscosity / n;
            known.local_element(node)                     = 1;
          }
        known.update_ghost_values();
        state.material->update_ghost_values();
      }
  }

  template void
  set_initial_material(State<2> &, const Scene<2> &);
  template void
  set_initial_material(State<3> &, const Scene<3> &);
  template void
  extend_material(State<2> &, const unsigned int);
  template void
  extend_material(State<3> &, const unsigned int);
} // namespace treacle
