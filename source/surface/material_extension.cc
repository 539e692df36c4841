// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/layers.h>
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
  extend_material(State<dim> &state, const MeshData<dim> &data, const unsigned int n_layers)
  {
    const Mesh<dim> &mesh  = data.mesh;
    Vector           known = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      known.local_element(node) = state.phi.local_element(node) < 0;
    Vector &density = state.material->density, &viscosity = state.material->viscosity;
    continue_outwards(
      data,
      known,
      n_layers,
      [&](const LocalIndex node) {
        return Tensor<1, 2>({density.local_element(node), viscosity.local_element(node)});
      },
      [&](const LocalIndex node, const Tensor<1, 2> &value) {
        density.local_element(node)   = value[0];
        viscosity.local_element(node) = value[1];
      },
      [&] { state.material->update_ghost_values(); });
  }

  template void
  set_initial_material(State<2> &, const Scene<2> &);
  template void
  set_initial_material(State<3> &, const Scene<3> &);
  template void
  extend_material(State<2> &, const MeshData<2> &, const unsigned int);
  template void
  extend_material(State<3> &, const MeshData<3> &, const unsigned int);
} // namespace treacle
