// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/surface/emission.h>
#include <treacle/surface/extrapolation.h>
#include <treacle/surface/material_extension.h>
#include <treacle/transport/remesh.h>
#include <treacle/transport/transport.h>

namespace treacle
{
  template <int dim>
  typename Transport<dim>::Info
  Transport<dim>::move_liquid(Liquid<dim>              &liquid,
                              const BackwardDifference &difference,
                              const double              volume,
                              Timing                   &timing) const
  {
    const State<dim>    &old   = *liquid.state;
    const double         reach = time_step.reach(old, *liquid.domain);
    const Advection<dim> advection(prm.advection, old, *liquid.domain, *liquid.surface, difference);
    const auto           markers = timing.measured("markers", [&] {
      return advection.move_markers();
    });
    const auto           mesh    = timing.measured("mesh", [&] {
      return mesh_for_next_surface(old, scene, *liquid.surface, advection, markers, difference.dt);
    });
    const bool           rebuilt = mesh != old.mesh;
    auto                 next    = timing.measured("advection", [&] {
      return carry(old, advection, mesh, reach);
    });

    const auto section = timing.section("surface");
    auto       data    = rebuilt ? std::make_shared<const MeshData<dim>>(*mesh, scene) :
                                   liquid.mesh_data;
    next->markers        = to_owners(*mesh, markers);
    const double emitted = emit(*next, *data, difference.dt);
    auto         surface =
      tracking.advance(*next, *data, time_step.reach_of_distance(reach, *mesh), volume + emitted);
    if (next->material)
      extend_material(*next, *data);
    liquid = {std::move(data), std::move(next), std::move(surface), nullptr};
    return {rebuilt, emitted};
  }

  template <int dim>
  std::unique_ptr<State<dim>>
  Transport<dim>::carry(const State<dim>                       &old,
                        const Advection<dim>                   &advection,
                        const std::shared_ptr<const Mesh<dim>> &mesh,
                        const double                            reach) const
  {
    auto next = std::make_unique<State<dim>>(advection.advance(mesh, reach));
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
    auto                 next =
      carry(old, advection, old.mesh, time_step.reach(old, *liquid.domain));
    next->phi                 = old.phi;
    next->markers             = std::move(old.markers);
    next->phi.update_ghost_values();
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
  void
  Transport<dim>::extend_velocity(Liquid<dim> &liquid) const
  {
    State<dim> &state = *liquid.state;
    extrapolate(
      state, *liquid.domain, *liquid.surface, time_step.reach(state, *liquid.domain));
  }

  template <int dim>
  void
  Transport<dim>::extend_material(State<dim> &state, const MeshData<dim> &data) const
  {
    treacle::extend_material(state,
                             data,
                             static_cast<unsigned int>(std::ceil(prm.time_step.cfl)) + 3);
  }

  template class Transport<2>;
  template class Transport<3>;
} // namespace treacle
