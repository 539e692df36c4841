// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/moved_points.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/emission.h>
#include <treacle/surface/emitted_volume.h>
#include <treacle/surface/emitter_divergence.h>

namespace treacle
{
  namespace
  {
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
        {
          set(point.position, point.density, point.viscosity);
          set(point.position, point.mean_density, point.mean_viscosity);
        }
      throw_first(mesh.communicator(), error);
      material.update_ghost_values();
    }

    template <int dim>
    struct Filled
    {
      std::vector<Parcel<dim>> inflow;
      std::vector<double>      to_emitters; ///< distances of nodes (m)
    };

    /// Cuts the liquid in emitters and beside them out of state.phi, and puts the emitters
    /// in. Returns what flowed in. Collective.
    template <int dim>
    Filled<dim>
    fill_emitters(State<dim> &state, const MeshData<dim> &data, const EmitterFilling<dim> &filling)
    {
      const Mesh<dim>           &mesh = *state.mesh;
      const std::vector<double> &psi  = data.solid_distance(state.time);
      std::string                error;
      EmittedVolume<dim>         emitted(filling);
      Vector                     filled(mesh.nodes);
      Filled<dim>                result{{}, std::vector<double>(mesh.node_position.size())};
      for (LocalIndex node = 0; node < mesh.node_position.size(); ++node)
        keep_error(error, [&] {
          const auto &vertex =
            emitted.add(mesh.node_position[node], state.phi.local_element(node), psi[node], state.v.value(node));
          result.to_emitters[node] = vertex.phi.to_emitters;
          if (node < mesh.n_owned_nodes())
            filled.local_element(node) = vertex.phi.after;
        });
      throw_first(mesh.communicator(), error);
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        if (const auto &nodes = mesh.cell_nodes[c];
            std::any_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) {
              return emitted[node].phi.inside != emitted[node].phi.kept;
            }))
          keep_error(error, [&] { result.inflow.push_back({barycentre<dim>(mesh.cell_vertices(c)), emitted(nodes)}); });
      throw_first(mesh.communicator(), error);
      filled.update_ghost_values();
      state.phi = filled;
      state.phi.update_ghost_values();
      return result;
    }

    /// Emitters that have poured for a time @p dt until @p time take the markers inside away, for the liquid that these bounded has come
    /// in from behind. Along its sides and its back the stream is bounded by the emitter itself, and markers lie there: of those that are
    /// about there only those outside would be left, and make it wider on its way (one of two leaves' radius by 5 % of its volume).
    template <int dim>
    void
    settle_markers(State<dim>                &state,
                   const Scene<dim>          &scene,
                   const EmitterFilling<dim> &filling,
                   const double               h,
                   const double               time,
                   const double               dt)
    {
      constexpr double    inside = 0.1, about = 0.25, across = 0.02; // leaves
      constexpr double    alike = 0.45;                              // cosine of normals
      const Distance<dim> distance  = distance_to_filled(scene, h, time);
      const auto          is_behind = [&](const Marker<dim> &marker, const Marker<dim> &on) {
        if (!(on.normal * marker.normal > alike))
          return false;
        const double ahead = dt * scene.emitter_velocity(on.position, time) * on.normal;
        return ahead < across * h && on.position.distance(marker.position) < about * h + std::max(0., -ahead);
      };
      std::vector<Marker<dim>> kept, on_emitter;
      const auto               settle = [&](const Marker<dim> &marker, const Tensor<1, dim> &v) {
        if (distance(marker.position) < about * h)
          if (const auto on = marker_on(distance, marker.position, 1e-3 * h); is_behind(marker, on))
            return on_emitter.push_back(on);
        const double to_filled = filling.distance(marker.position, v);
        if (to_filled >= -inside * h && !filling.is_skin(marker.position, v, to_filled))
          kept.push_back(marker);
      };
      const std::vector<double> v = Tracer<dim>(*state.mesh).evaluate(positions(state.markers), fields_of(state.v));
      std::string               error;
      keep_error(error, [&] {
        for (unsigned int k = 0; k < state.markers.size(); ++k)
          settle(state.markers[k], Tensor<1, dim>(ArrayView<const double>(&v[k * dim], dim)));
      });
      throw_first(state.mesh->communicator(), error);
      clamp(*state.mesh, on_emitter);
      kept.insert(kept.end(), on_emitter.begin(), on_emitter.end());
      state.markers = to_owners(*state.mesh, kept);
    }
  } // namespace

  template <int dim>
  std::vector<Parcel<dim>>
  emit(State<dim> &state, const MeshData<dim> &data, const double dt, const Room &room)
  {
    // steps end where emitters start and stop
    const Scene<dim> &scene = data.scene;
    const double      h = data.mesh.finest_size(), end = state.time, start = std::max(0., end - dt),
                 middle    = 0.5 * (start + end);
    constexpr double         near_full = 4; // layers: what is cut off at a wall there would take in all that is poured
    std::vector<Parcel<dim>> inflow;
    const auto fill_with = [&](const double time, const double earlier, const double way) {
      const EmitterFilling<dim> filling(scene, h, time, earlier, way, room.air > near_full * room.layer);
      const auto [filled, to_emitters] = fill_emitters(state, data, filling);
      for (const auto &part : {filled, made_in_emitters(data, to_emitters, state.time, time, way)})
        inflow.insert(inflow.end(), part.begin(), part.end());
      if (state.material)
        set_material(state, scene, time);
      settle_markers(state, scene, filling, h, time, way);
    };
    const auto any = [&](const auto &is) {
      return std::any_of(scene.emitters().begin(), scene.emitters().end(), is);
    };
    if (any([&](const Emitter<dim> &emitter) { return emitter.is_at_work(middle); }))
      fill_with(middle, start, dt);
    // at once, as at t = 0 those that start there
    if (any([&](const Emitter<dim> &emitter) {
          return emitter.is_at_work(end) && !emitter.is_at_work(middle);
        }))
      fill_with(end, middle, 0);
    const double most = scene.has_moving_solids() ? std::numeric_limits<double>::max() : std::max(0., room.air);
    if (const double poured = sum(inflow, data.mesh.communicator()); poured > most)
      for (Parcel<dim> &parcel : inflow)
        parcel.volume *= most / poured;
    return inflow;
  }

  template std::vector<Parcel<2>>
  emit(State<2> &, const MeshData<2> &, const double, const Room &);
  template std::vector<Parcel<3>>
  emit(State<3> &, const MeshData<3> &, const double, const Room &);
} // namespace treacle
