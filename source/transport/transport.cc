// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
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
    /// Part of the volume that is pushed out of walls in a step, and not left to the even
    /// correction: that lifts the whole body.
    constexpr double least_lost = 1e-4;

    /// Volume that facets move over (m^dim). Collective.
    template <int dim>
    double
    swept_outwards(const State<dim> &state, const Surface<dim> &surface, const std::vector<Point<dim>> &after)
    {
      double volume = 0;
      for (unsigned int k = 0; k < surface.facets.size(); ++k)
        {
          Tensor<1, dim> way;
          for (const unsigned int i : surface.facets[k])
            way += (after[i] - surface.positions[i]) / dim;
          volume += std::max(0., area_vector<dim>(surface.facet_points(k)) * way);
        }
      return Utilities::MPI::sum(volume, state.mesh->communicator());
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
    const Advection<dim> advection(prm.advection, old, *liquid.domain, *liquid.surface, difference);
    const auto           ends = timing.measured(
      "markers", [&] { return advection.move_surface(liquid.surface->facets.positions); });
    auto                 lost = timing.measured("surface", [&] {
      return lost_in_walls(scene, *old.mesh, liquid.surface->facets, ends, old.time, old.time + difference.dt);
    });
    const double         all_lost = sum(lost, old.mesh->communicator());
    if (all_lost > most_lost)
      return {};
    const auto markers = timing.measured("markers", [&] { return advection.move_markers(); });
    const auto mesh    = timing.measured("mesh", [&] {
      return mesh_for_next_surface(
        old, *liquid.domain, *liquid.surface, advection, ends, markers, difference.dt);
    });
    auto       next    = timing.measured("advection", [&] {
      return carry(old, advection, mesh, reach, Advection<dim>::SurfaceMotion::carried);
    });

    const auto section = timing.section("surface");
    const bool rebuilt = mesh != old.mesh;
    auto       data    = rebuilt ? std::make_shared<const MeshData<dim>>(*mesh, scene) : liquid.mesh_data;
    next->markers        = to_owners(*mesh, markers);
    const double emitted = emit(*next, *data, difference.dt);
    tracking.follow_markers(*next, *data, difference.dt, time_step.reach_of_distance(reach, *mesh));
    const double wanted  = volume + emitted;
    // what earlier steps left to be corrected is not of this one
    const double won = liquid_volume(*data, next->phi, next->time) - emitted -
                       liquid.domain->total_volume();
    double missing = 0, swallowed = 0;
    if (tracking.keeps_volume() && -won >= least_lost * wanted)
      {
        const auto in_liquid = lost_in_liquid(scene, *next, *old.mesh, liquid.surface->facets, ends);
        lost.insert(lost.end(), in_liquid.begin(), in_liquid.end());
        missing = std::min(sum(lost, mesh->communicator()), -won);
        if (missing < least_lost * wanted)
          missing = 0;
        swallowed = (-won - missing) / swept_outwards(old, liquid.surface->facets, ends);
      }
    auto surface = tracking.settle(*next, *data, wanted - missing);
    settle_material(*next, *data);
    liquid = {std::move(data), std::move(next), std::move(surface), nullptr};
    return Info{rebuilt, emitted, std::move(lost), missing, (won + missing) / wanted, swallowed};
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
            if (scene.solid_distance(centre, state.time) >= 0)
              flux += area_vector<dim>(x) * v;
          });
        }
      throw_first(state.mesh->communicator(), error);
      return Utilities::MPI::sum(flux, state.mesh->communicator());
    }
  } // namespace

  template <int dim>
  void
  Transport<dim>::displace(Liquid<dim>       &liquid,
                           const Liquid<dim> &pushed,
                           const double       swept,
                           const double       volume) const
  {
    State<dim>  &state = *liquid.state;
    const double reach = time_step.reach(state, *liquid.domain);
    const double flux  = flux_through_surface(scene, liquid.surface->facets, *pushed.state);
    if (flux <= 0)
      return;
    const double         dt = std::min(swept / flux, 3.);
    const Advection<dim> advection(prm.advection,
                                   *pushed.state,
                                   *pushed.domain,
                                   *pushed.surface,
                                   BackwardDifference(dt, *pushed.state),
                                   false);
    const std::vector<double> phi = advection.level_set(
      {state.mesh->node_position.begin(),
       state.mesh->node_position.begin() + state.mesh->n_owned_nodes()});
    std::copy(phi.begin(), phi.end(), state.phi.begin());
    state.phi.update_ghost_values();
    state.markers = to_owners(*state.mesh, advection.move_markers());
    liquid.surface =
      tracking.advance(state, *liquid.mesh_data, time_step.reach_of_distance(reach, *state.mesh), volume);
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
    auto next = std::make_unique<State<dim>>(advection.advance(mesh, reach, motion));
    if (remembers(old.time))
      next->before = advection.velocity_before(*mesh);
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
    VelocityBefore<dim> before{difference.dt, {}, state.u};
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
    VelocityBefore<dim> before{dt, {}, is_advected ? missed_by_nodes(*now.state, *now.domain) : now.state->u};
    if (is_advected)
      before.v = combined(2, now.state->v, -1, ahead.state->v);
    before.u->zero_out_ghost_values();
    before.u->sadd(
      2, -1, is_advected ? missed_by_nodes(*ahead.state, *ahead.domain) : ahead.state->u);
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
