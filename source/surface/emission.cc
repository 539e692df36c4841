// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/liquid_volume.h>
#include <treacle/surface/emission.h>

namespace treacle
{
  namespace
  {
    /// How far a point is beyond the box or in a solid (m), negative in the open.
    template <int dim>
    double
    depth_beyond(const Point<dim> &x, const Scene<dim> &scene, const double time)
    {
      double depth = -scene.solid_distance(x, time);
      for (unsigned int d = 0; d < dim; ++d)
        depth = std::max({depth, scene.lower_corner()[d] - x[d], x[d] - scene.upper_corner()[d]});
      return depth;
    }

    template <int dim>
    Point<dim>
    in_box(Point<dim> x, const Scene<dim> &scene)
    {
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::min(std::max(x[d], scene.lower_corner()[d]), scene.upper_corner()[d]);
      return x;
    }

    template <int dim>
    void
    set_material(State<dim> &state, const Scene<dim> &scene, const double time)
    {
      const Mesh<dim>      &mesh     = *state.mesh;
      CarriedMaterial<dim> &material = *state.material;
      std::string           error;
      const auto            set = [&](const Point<dim> &x, double &density, double &viscosity) {
        for (const Emitter<dim> &emitter : scene.emitters())
          if (emitter.is_at_work(time) && emitter.signed_distance(x) <= 0)
            keep_error(error, [&] {
              density   = emitter.material.density(x, time);
              viscosity = emitter.material.viscosity(x, time);
            });
      };
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        set(mesh.node_position[node],
            material.density.mean.local_element(node),
            material.viscosity.mean.local_element(node));
      for (MaterialPoint<dim> &point : material.points)
        set(point.position, point.density, point.viscosity);
      throw_first(mesh.communicator(), error);
      material.update_ghost_values();
    }
  } // namespace

  namespace
  {
    /// Cuts the liquid in emitters and beside them out of state.phi, and puts the emitters
    /// in. Returns what was liquid before, @p dt ago. Full then were the emitters that worked
    /// @p earlier.
    template <int dim>
    Vector
    fill_emitters(State<dim>       &state,
                  const Scene<dim> &scene,
                  const double      time,
                  const double      earlier,
                  const double      dt)
    {
      // what came from inside the emitter, and what was there already. Paths that lead back
      // through a wall bring none: what sticks to the ceiling beside an emitter, as a skin
      // of it, must not become a second one
      const Mesh<dim> &mesh   = *state.mesh;
      const double     h      = mesh.finest_size();
      Vector           before = state.phi;
      before.zero_out_ghost_values();
      state.phi.zero_out_ghost_values();
      std::string error;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          const Point<dim> &x        = mesh.node_position[node];
          const double      distance = scene.emitter_distance(x, time);
          double           &phi      = state.phi.local_element(node);
          if (distance >= 2 * h)
            {
              phi                        = std::min(phi, distance);
              before.local_element(node) = phi;
              continue;
            }
          keep_error(error, [&] {
            const Point<dim> from = x - dt * scene.emitter_velocity(x, time);
            const double depth = depth_beyond(from, scene, time), old = phi;
            before.local_element(node) =
              std::max(std::min(old, scene.emitter_distance(from, earlier)), depth);
            if (depth > 0 && old > -h && scene.emitter_distance(in_box(from, scene), time) > 0)
              phi = std::max(old, depth);
            phi = std::min(phi, distance);
          });
        }
      throw_first(mesh.communicator(), error);
      before.update_ghost_values();
      state.phi.update_ghost_values();
      return before;
    }
  } // namespace

  template <int dim>
  double
  emit(State<dim> &state, const MeshData<dim> &data, const double dt)
  {
    // steps end where emitters start and stop. Full when this one began were those that worked
    // just before it, and at t = 0 those that start there
    const Scene<dim> &scene = data.scene;
    const double time = state.time - 0.5 * dt, earlier = std::max(0., state.time - 1.001 * dt);
    if (std::none_of(scene.emitters().begin(), scene.emitters().end(), [&](const auto &emitter) {
          return emitter.is_at_work(time);
        }))
      return 0;
    const Vector before = fill_emitters(state, scene, time, earlier, dt);
    if (state.material)
      set_material(state, scene, time);
    // the liquid that they bounded has come in from behind
    const auto is_inside = [&](const Marker<dim> &marker) {
      return scene.emitter_distance(marker.position, time) < -0.1 * data.mesh.finest_size();
    };
    state.markers.erase(std::remove_if(state.markers.begin(), state.markers.end(), is_inside),
                        state.markers.end());
    before.update_ghost_values();
    return liquid_volume(data, state.phi, state.time) - liquid_volume(data, before, state.time);
  }

  template double
  emit(State<2> &, const MeshData<2> &, const double);
  template double
  emit(State<3> &, const MeshData<3> &, const double);
} // namespace treacle
