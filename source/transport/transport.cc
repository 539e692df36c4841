// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/full_container.h>
#include <treacle/fields/liquid_volume.h>
#include <treacle/fields/moved_points.h>
#include <treacle/surface/carried_material.h>
#include <treacle/surface/emission.h>
#include <treacle/surface/extrapolation.h>
#include <treacle/transport/face_residual.h>
#include <treacle/transport/remesh.h>
#include <treacle/transport/transport.h>
#include <treacle/transport/velocity_in_time.h>

namespace treacle
{
  namespace
  {
    /// Part of the volume that is pushed out of walls and other liquid in a step, and not left to the even
    /// correction: that lifts the whole body.
    constexpr double least_lost = 1e-4;
    /// A surface that moves by fewer leaves keeps its distances and markers.
    constexpr double far = 0.1;

    /// What a step that came to a @p state did to the volume that the liquid had before it, of what is @p wanted (m^dim), beside what
    /// emitters did: what is missing in walls and liquid, and what was lost otherwise. Collective.
    template <int dim>
    void
    account_for(typename Transport<dim>::Info  &info,
                const double                    before,
                const double                    wanted,
                const bool                      is_kept,
                const std::vector<Parcel<dim>> &inflow,
                const MovedSurface<dim>        &surface,
                const MeshData<dim>            &data,
                const State<dim>               &state)
    {
      const double won = liquid_volume(data, state.phi, state.time) - info.emitted - before;
      if (is_kept && -won > least_lost * wanted) // nor where there is no liquid
        {
          const auto in_liquid = lost_in_liquid(data.scene, surface, state);
          info.lost.insert(info.lost.end(), in_liquid.begin(), in_liquid.end());
          info.missing = std::min(sum(info.lost, surface.mesh.communicator()), -won);
          if (info.missing < least_lost * wanted)
            info.missing = 0;
          info.swallowed = (-won - info.missing) / (swept_outwards(surface) + taken(inflow, surface.mesh.communicator()));
        }
      info.drift = wanted > 0 ? (won + info.missing) / wanted : 0;
    }

    /// All liquid after a move: what the cells had, what came in, and a @p part (m^dim) of what was lost. Collective.
    template <int dim>
    std::vector<Parcel<dim>>
    all_parcels(const Advection<dim>               &advection,
                const std::vector<Parcel<dim>>     &inflow,
                const std::vector<LostVolume<dim>> &lost,
                const double                        part,
                const Mesh<dim>                    &mesh)
    {
      auto result = advection.move_parcels();
      result.insert(result.end(), inflow.begin(), inflow.end());
      const auto of_lost = parcels_of(lost, part, 0.5 * mesh.finest_size(), mesh.communicator());
      result.insert(result.end(), of_lost.begin(), of_lost.end());
      return result;
    }
  } // namespace

  template <int dim>
  std::optional<typename Transport<dim>::Info>
  Transport<dim>::move_liquid(Liquid<dim>              &liquid,
                              const BackwardDifference &difference,
                              const double              volume,
                              const double              most_lost,
                              Timing                   &timing) const
  {
    const State<dim>    &old   = *liquid.state;
    const double         reach = time_step.reach(old, *liquid.domain);
    const Advection<dim> advection = timing.measured("advection", [&] {
      return Advection<dim>(prm.advection, old, *liquid.domain, *liquid.surface, difference);
    });
    const auto ends =
      timing.measured("markers", [&] { return advection.move_surface(liquid.surface->facets.positions); });
    const MovedSurface<dim> moved{*old.mesh, liquid.surface->facets, ends};
    Info                    info;
    info.lost =
      timing.measured("surface", [&] { return lost_in_walls(scene, moved, old.time, old.time + difference.dt); });
    if (sum(info.lost, old.mesh->communicator()) > most_lost)
      return {};
    const auto markers = timing.measured("markers", [&] { return advection.move_markers(); });
    const auto mesh = timing.measured("mesh", [&] {
      return mesh_for_next_surface(old, *liquid.domain, *liquid.surface, advection, ends, markers, difference.dt);
    });
    auto next = timing.measured("advection", [&] {
      return carry(old, advection, mesh, reach, Advection<dim>::SurfaceMotion::carried);
    });

    const auto section = timing.section("surface");
    info.rebuilt       = mesh != old.mesh;
    auto data          = info.rebuilt ? std::make_shared<const MeshData<dim>>(*mesh, scene) : liquid.mesh_data;
    next->markers      = to_owners(*mesh, markers);
    const double before = liquid.domain->total_volume(), missing = tracking.keeps_volume() ? volume - before : 0;
    const auto   inflow = liquid.domain->emitters_rest ? std::vector<Parcel<dim>>() : emit(*next, *data, difference.dt, room(*liquid.domain, missing));
    info.emitted       = sum(inflow, mesh->communicator());
    tracking.follow_markers(*next, *data, difference.dt, time_step.reach_of_distance(reach, *mesh));
    const double wanted = volume + info.emitted; // what earlier steps left to be corrected is not of this one
    account_for<dim>(info, before, wanted, tracking.keeps_volume(), inflow, moved, *data, *next);
    auto surface = tracking.settle(*next, *data, wanted - info.missing, [&] {
      return all_parcels<dim>(advection, inflow, info.lost, -info.missing, *mesh);
    });
    settle_material(*next, *data);
    liquid = {std::move(data), std::move(next), std::move(surface), nullptr};
    return info;
  }

  namespace
  {
    /// Volume that the surface sweeps, outside of solids (m^dim/s). Collective.
    template <int dim>
    double
    flux_through_surface(const Scene<dim> &scene, const Surface<dim> &surface, const State<dim> &state)
    {
      double      flux = 0;
      std::string error;
      for (unsigned int k = 0; k < surface.facets.size(); ++k)
        {
          const std::array<Point<dim>, dim> x = surface.facet_points(k);
          Tensor<1, dim>                    v;
          Point<dim>                        centre;
          for (unsigned int i = 0; i < dim; ++i)
            {
              const auto &vertex = surface.vertices[surface.facets[k][i]];
              v += ((1 - vertex.t) * state.v.value(vertex.a) + vertex.t * state.v.value(vertex.b)) / dim;
              centre += x[i] / dim;
            }
          keep_error(error, [&] {
            if (!scene.is_in_solids(centre, state.time))
              flux += area_vector<dim>(x) * v;
          });
        }
      throw_first(state.mesh->communicator(), error);
      return Utilities::MPI::sum(flux, state.mesh->communicator());
    }

    /// Does a way to a point at a @p distance from solids come through one, or in one along its normal?
    template <int dim>
    bool
    leads_through_solid(const Scene<dim> &scene,
                        const Point<dim> &from,
                        const Point<dim> &to,
                        const double      distance,
                        const double      time,
                        const double      h)
    {
      const Tensor<1, dim> way = to - from;
      if (distance > way.norm() || way.norm() < 0.1 * h)
        return false;
      if (distance <= 0)
        return std::abs(scene.solid_distance(from, time) - distance) > 0.1 * h;
      bool is_through = false;
      for (const double part : {0., 0.25, 0.5, 0.75})
        is_through = is_through || scene.solid_distance_within(from + part * way, h, time) < -0.25 * h;
      return is_through;
    }

    /// phi from where the surface comes from; not through a solid: what is behind one has no part in it. Collective.
    template <int dim>
    void
    move_level_set(State<dim> &state, const MeshData<dim> &data, const Advection<dim> &advection)
    {
      const Mesh<dim>              &mesh           = *state.mesh;
      const std::vector<double>    &solid_distance = data.solid_distance(state.time);
      const std::vector<Point<dim>> x(mesh.node_position.begin(),
                                      mesh.node_position.begin() + mesh.n_owned_nodes());
      const auto                    feet = advection.feet(x);
      std::string                   error;
      keep_error(error, [&] {
        for (LocalIndex node = 0; node < x.size(); ++node)
          if (!leads_through_solid(
                data.scene, feet.from[node], x[node], solid_distance[node], state.time, mesh.finest_size()))
            state.phi.local_element(node) = feet.phi[node];
      });
      throw_first(mesh.communicator(), error);
      state.phi.update_ghost_values();
    }
  } // namespace

  template <int dim>
  void
  Transport<dim>::displace(Liquid<dim>       &liquid,
                           const Liquid<dim> &pushed,
                           const Info        &moved,
                           const double       volume) const
  {
    State<dim>  &state = *liquid.state;
    const double flux  = flux_through_surface(scene, liquid.surface->facets, *pushed.state);
    if (flux <= 0)
      return;
    const double         dt = std::min(moved.missing / flux, 3.);
    const Advection<dim> advection(
      prm.advection, *pushed.state, *pushed.domain, *pushed.surface, BackwardDifference(dt, *pushed.state), false);
    move_level_set(state, *liquid.mesh_data, advection);
    state.markers = to_owners(*state.mesh, advection.move_markers());
    const auto parcels = [&] {
      return all_parcels<dim>(advection, {}, moved.lost, moved.missing, *state.mesh);
    };
    liquid.surface = dt * fastest_crossing(*pushed.domain, pushed.state->v) > far ?
                       tracking.advance(state,
                                        *liquid.mesh_data,
                                        time_step.reach_of_distance(time_step.reach(state, *liquid.domain), *state.mesh),
                                        volume,
                                        parcels) :
                       tracking.settle(state, *liquid.mesh_data, volume, parcels);
    if (state.material)
      state.material->points = to_owners(*state.mesh, advection.move_material());
    settle_material(state, *liquid.mesh_data);
    liquid.domain.reset();
  }

  template <int dim>
  std::unique_ptr<State<dim>>
  Transport<dim>::carry(const State<dim>                       &old,
                        const Advection<dim>                   &advection,
                        const std::shared_ptr<const Mesh<dim>> &mesh,
                        const double                            reach,
                        const typename Advection<dim>::SurfaceMotion motion) const
  {
    using Memory = typename Advection<dim>::Memory;
    auto next    = std::make_unique<State<dim>>(
      advection.advance(mesh, reach, motion, remembers(old.time) ? Memory::velocity : Memory::none));
    // the next solves begin with it
    next->v = advection.velocity_at_end(*mesh);
    // a state that is moved may keep its old ghosts
    next->phi.update_ghost_values();
    next->u.update_ghost_values();
    next->v.update_ghost_values();
    return next;
  }

  template <int dim>
  void
  Transport<dim>::move_velocity(Liquid<dim>              &liquid,
                                const BackwardDifference &difference,
                                Timing                   &timing) const
  {
    const auto           section = timing.section("advection");
    State<dim>          &old     = *liquid.state;
    const Advection<dim> advection(prm.advection, old, *liquid.domain, *liquid.surface, difference);
    auto                 next = carry(old,
                      advection,
                      old.mesh,
                      time_step.reach(old, *liquid.domain),
                      Advection<dim>::SurfaceMotion::none);
    next->markers             = std::move(old.markers);
    settle_material(*next, *liquid.mesh_data);
    liquid.domain.reset();
    liquid.state = std::move(next);
  }

  template <int dim>
  void
  Transport<dim>::stay(State<dim> &state, const BackwardDifference &difference) const
  {
    const double        time = state.time;
    VelocityBefore<dim> before{difference.dt, {}, {}, state.u};
    state.u.zero_out_ghost_values();
    if (difference.before != 0)
      state.u.sadd(difference.now, difference.before, *state.before->u);
    before.u->update_ghost_values();
    state.u.update_ghost_values();
    state.before.reset();
    if (remembers(time))
      state.before = std::move(before);
    state.time += difference.dt;
    ++state.step;
  }

  template <int dim>
  VelocityBefore<dim>
  Transport<dim>::mirrored(const Liquid<dim> &now,
                           const Liquid<dim> &ahead,
                           const double       dt,
                           const bool         is_advected)
  {
    VelocityBefore<dim> before{dt, {}, {}, is_advected ? missed_by_nodes(*now.state, *now.domain) : now.state->u};
    if (is_advected)
      {
        before.v = combined(2, now.state->v, -1, ahead.state->v);
        before.v_along.emplace(now.state->mesh->nodes, std::numeric_limits<double>::quiet_NaN());
      }
    before.u->zero_out_ghost_values();
    before.u->sadd(2, -1, is_advected ? missed_by_nodes(*ahead.state, *ahead.domain) : ahead.state->u);
    before.u->update_ghost_values();
    return before;
  }

  template <int dim>
  void
  Transport<dim>::extend_velocity(Liquid<dim> &liquid) const
  {
    State<dim> &state = *liquid.state;
    extrapolate(
      state, *liquid.domain, *liquid.surface, time_step.reach(state, *liquid.domain));
  }

  template <int dim>
  void
  Transport<dim>::settle_material(State<dim> &state, const MeshData<dim> &data) const
  {
    if (state.material)
      treacle::settle_material(state,
                               data,
                               static_cast<unsigned int>(std::ceil(prm.time_step.cfl)) + 3);
  }

  template class Transport<2>;
  template class Transport<3>;
} // namespace treacle
