// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/layers.h>
#include <treacle/surface/carried_material.h>
#include <treacle/surface/material_points.h>

namespace treacle
{
  template <int dim>
  void
  set_initial_material(State<dim> &state, const MeshData<dim> &data)
  {
    const Mesh<dim>  &mesh  = data.mesh;
    const Scene<dim> &scene = data.scene;
    state.material.emplace(mesh.nodes);
    std::string error;
    const auto  point = [&](const Point<dim> &x) {
      MaterialPoint<dim> result{x, 1, 0};
      keep_error(error, [&] {
        const Material<dim> &material = scene.initial_material(x);
        result                        = {x, material.density(x, 0.), material.viscosity(x, 0.)};
      });
      return result;
    };
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (state.phi.local_element(node) < 0)
        {
          const auto [x, density, viscosity]                  = point(mesh.node_position[node]);
          state.material->density.mean.local_element(node)   = density;
          state.material->viscosity.mean.local_element(node) = viscosity;
        }
    throw_first(mesh.communicator(), error);
    MaterialPoints<dim>(state, data).reseed(
      [&](const Point<dim> &x, LocalIndex, const VertexValues<dim> &) { return point(x); });
    throw_first(mesh.communicator(), error);
  }

  template <int dim>
  void
  settle_material(State<dim> &state, const MeshData<dim> &data, const unsigned int n_layers)
  {
    MaterialPoints<dim> points(state, data);
    Vector              known = points.nodes_that_know();
    CarriedField       &density = state.material->density, &viscosity = state.material->viscosity;
    continue_outwards(
      data,
      known,
      n_layers,
      [&](const LocalIndex node) {
        return Tensor<1, 2>({density.mean.local_element(node), viscosity.mean.local_element(node)});
      },
      [&](const LocalIndex node, const Tensor<1, 2> &value) {
        density.set(node, value[0]);
        viscosity.set(node, value[1]);
      },
      [&] { state.material->update_ghost_values(); });
    // cells at the surface have nodes in the air
    points.reseed([&](const auto &...where) { return points.point(where...); });
  }

  template void
  set_initial_material(State<2> &, const MeshData<2> &);
  template void
  set_initial_material(State<3> &, const MeshData<3> &);
  template void
  settle_material(State<2> &, const MeshData<2> &, const unsigned int);
  template void
  settle_material(State<3> &, const MeshData<3> &, const unsigned int);
} // namespace treacle
