// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/layers.h>
#include <treacle/surface/carried_material.h>
#include <treacle/surface/initial_jumps.h>
#include <treacle/surface/material_points.h>

namespace treacle
{
  namespace
  {
    /// What liquid is made of at t = 0. Errors of formulas are kept.
    template <int dim>
    struct InitialMaterial
    {
      const Scene<dim> &scene;
      std::string       error = {};

      /// Density and viscosity.
      std::array<double, 2>
      operator()(const Point<dim> &x)
      {
        std::array<double, 2> result{{1, 0}};
        keep_error(error, [&] {
          const Material<dim> &material = scene.initial_material(x);
          result                        = {{material.density(x, 0.), material.viscosity(x, 0.)}};
        });
        return result;
      }

      /// At the nodes in the liquid, also ghosts; elsewhere NaN: what would be there is not asked.
      std::array<std::vector<double>, 2>
      at_nodes(const State<dim> &state)
      {
        const Mesh<dim>                   &mesh = *state.mesh;
        std::array<std::vector<double>, 2> result;
        for (auto &values : result)
          values.resize(mesh.node_position.size(), std::numeric_limits<double>::quiet_NaN());
        for (LocalIndex node = 0; node < mesh.node_position.size(); ++node)
          if (state.phi.local_element(node) < 0)
            {
              const auto [density, viscosity] = (*this)(mesh.node_position[node]);
              result[0][node]                 = density;
              result[1][node]                 = viscosity;
            }
        return result;
      }
    };

    /// Into the air: in each of @p n_layers of cells nodes take the mean of those around them that have a value already. Collective.
    template <int dim>
    void
    continue_material(State<dim> &state, const MeshData<dim> &data, Vector known, const unsigned int n_layers)
    {
      CarriedField &density = state.material->density, &viscosity = state.material->viscosity;
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
    }
  } // namespace

  template <int dim>
  void
  set_initial_material(State<dim> &state, const MeshData<dim> &data)
  {
    const Mesh<dim>     &mesh = data.mesh;
    InitialMaterial<dim> initial{data.scene};
    const auto           at_nodes = initial.at_nodes(state);
    state.material.emplace(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (!std::isnan(at_nodes[0][node]))
        {
          state.material->density.mean.local_element(node)   = at_nodes[0][node];
          state.material->viscosity.mean.local_element(node) = at_nodes[1][node];
        }
    throw_first(mesh.communicator(), initial.error);
    MaterialPoints<dim> points(state, data);
    continue_material(state, data, points.nodes_that_know(), 1); // cells at the surface have nodes in the air
    std::array<Vector, 2> know_planes;
    for (unsigned int k = 0; k < 2; ++k)
      {
        know_planes[k] = set_means_about_jumps<dim>(
          data, *points.properties()[k], at_nodes[k], [&](const Point<dim> &x) { return initial(x)[k]; });
        know_planes[k].update_ghost_values();
      }
    state.material->update_ghost_values();
    points.reseed([&](const Point<dim> &x, const LocalIndex cell, const VertexValues<dim> &lambda) {
      MaterialPoint<dim> point   = points.point(x, cell, lambda);
      const auto         made_of = initial(x);
      for (unsigned int k = 0; k < 2; ++k)
        {
          const MaterialProperty<dim> &property = *points.properties()[k];
          point.*property.of_point              = made_of[k];
          // where there is no plane the points alone tell of the jump
          const VertexValues<dim> known = mesh.values(cell, know_planes[k]);
          if (*std::min_element(known.begin(), known.end()) == 0)
            point.*property.mean_of_point = made_of[k];
        }
      return point;
    });
    throw_first(mesh.communicator(), initial.error);
  }

  template <int dim>
  void
  settle_material(State<dim> &state, const MeshData<dim> &data, const unsigned int n_layers)
  {
    MaterialPoints<dim> points(state, data);
    continue_material(state, data, points.nodes_that_know(), n_layers);
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
