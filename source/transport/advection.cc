// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/fields/face_node.h>
#include <treacle/fields/moved_points.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/face_advection.h>
#include <treacle/transport/face_residual.h>
#include <treacle/transport/surface_velocity.h>
#include <treacle/transport/time_step.h>
#include <treacle/transport/velocity_in_time.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    std::vector<Point<dim>>
    owned_nodes(const Mesh<dim> &mesh)
    {
      return {mesh.node_position.begin(), mesh.node_position.begin() + mesh.n_owned_nodes()};
    }
  } // namespace

  template <int dim>
  void
  Advection<dim>::Parameters::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Advection");
    add_choice<Scheme>(handler,
                       "Scheme",
                       scheme,
                       "How velocity and material are carried along: MacCormack's correction "
                       "keeps more of what is small, at about twice the work.",
                       {{"semi-Lagrangian", Scheme::semi_lagrangian},
                        {"MacCormack", Scheme::maccormack}});
    handler.leave_subsection();
  }

  template <int dim>
  Advection<dim>::Advection(const Parameters           &parameters,
                            const State<dim>           &old,
                            const LiquidDomain<dim>    &domain,
                            const SurfaceGeometry<dim> &surface,
                            const BackwardDifference   &difference,
                            const bool                  keeps_volume)
    : prm(parameters)
    , old(old)
    , domain(domain)
    , surface(surface)
    , difference(difference)
    , dt(difference.dt)
    , velocity([&] {
      const double reach = dt * maximum_speed(old, domain) + 2 * old.mesh->finest_size();
      std::optional<SurfaceDivergence<dim>> divergence;
      if (keeps_volume)
        divergence.emplace(old, surface.level_set.gradients(), domain);
      return velocity_in_step<dim>(old, domain, difference, reach, [&](const NodeVector<dim> &v) {
        return surface_velocity(old, domain, v, reach, divergence ? &*divergence : nullptr);
      });
    }())
  {}

  template <int dim>
  NodeVector<dim>
  Advection<dim>::at_nodes_of(const Mesh<dim> &mesh, const NodeVector<dim> &v) const
  {
    if (&mesh == old.mesh.get())
      return combined(1, v, 0, v);
    NodeVector<dim>           result(mesh.nodes);
    const std::vector<double> values =
      Tracer<dim>(*old.mesh).evaluate(owned_nodes(mesh), fields_of(v));
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        result.component[d].local_element(node) = values[dim * node + d];
    result.update_ghost_values();
    return result;
  }

  template <int dim>
  NodeVector<dim>
  Advection<dim>::velocity_at_end(const Mesh<dim> &mesh) const
  {
    return at_nodes_of(mesh, velocity.carried[4]);
  }

  template <int dim>
  typename Advection<dim>::Feet
  Advection<dim>::feet(const std::vector<Point<dim>> &x) const
  {
    Guesses guesses;
    Feet    result{Tracer<dim>(*old.mesh).trace(x, velocity.surface, -dt, guesses), {}};
    result.phi = surface.level_set.values(result.from, guesses);
    return result;
  }

  template <int dim>
  CarriedFields<dim>
  Advection<dim>::carried(std::vector<NodeField<dim>> &&fields,
                          const VelocityInStep<dim>   &velocity,
                          const double                 time,
                          const double                 reach) const
  {
    return prm.scheme == Scheme::maccormack ? CarriedFields<dim>(std::move(fields), old, velocity, time, reach) :
                                              CarriedFields<dim>(std::move(fields));
  }

  template <int dim>
  State<dim>
  Advection<dim>::advance(std::shared_ptr<const Mesh<dim>> mesh,
                          const double                     reach,
                          const SurfaceMotion              motion,
                          const Memory                     memory) const
  {
    State<dim> state(mesh);
    state.time = old.time + dt;
    state.step = old.step + 1;
    if (mesh == old.mesh)
      state.pressure = old.pressure;
    state.pressure.update_ghost_values();
    advance_nodes(state, reach);
    if (motion == SurfaceMotion::none)
      {
        state.phi = old.phi;
        state.phi.update_ghost_values();
      }
    const auto carry = [&](std::vector<NodeField<dim>> &&fields, const VelocityInStep<dim> &v, const double time) {
      return carried(std::move(fields), v, time, reach);
    };
    const bool      remembers = memory == Memory::velocity;
    NodeVector<dim> along     = FaceAdvection<dim>(old, domain, difference, velocity, carry).advance(state, remembers);
    if (remembers)
      state.before = {dt, at_nodes_of(*mesh, old.v), std::move(along), missed_by_nodes(old, domain, state)};
    return state;
  }

  template <int dim>
  void
  Advection<dim>::advance_nodes(State<dim> &state, const double reach) const
  {
    const Mesh<dim> &mesh = *state.mesh;
    PathEnds<dim>    ends(mesh, *old.mesh, velocity.surface[4]);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      ends.add_node(node);
    const std::vector<Point<dim>> from =
      Tracer<dim>(*old.mesh).trace(ends.x, velocity.surface, -dt, ends.cells, ends.velocity);
    const std::vector<double> values = surface.level_set.values(from, ends.cells);
    std::copy(values.begin(), values.end(), state.phi.begin());
    state.phi.update_ghost_values();
    if (!old.material)
      return;
    const CarriedFields<dim>  carry = carried(
      {{&old.material->density.mean}, {&old.material->viscosity.mean}}, velocity.surface, dt, reach);
    const std::vector<double> material =
      Tracer<dim>(*old.mesh).evaluate(from, carry.fields, ends.cells);
    state.material.emplace(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        state.material->density.mean.local_element(node)   = material[2 * node];
        state.material->viscosity.mean.local_element(node) = material[2 * node + 1];
      }
    state.material->points = to_owners(mesh, move_material());
    state.material->update_ghost_values();
  }

  template class Advection<2>;
  template class Advection<3>;
} // namespace treacle
