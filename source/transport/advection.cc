// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/fields/face_node.h>
#include <treacle/fields/moved_points.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/back_and_forth.h>
#include <treacle/transport/face_residual.h>
#include <treacle/transport/surface_velocity.h>
#include <treacle/transport/time_step.h>
#include <treacle/transport/velocity_in_time.h>

namespace treacle
{
  namespace
  {
    /// How far below the surface the change along paths is found at nodes, in leaves.
    constexpr double deep_leaves = 4;

    /// How far from the surface faces of the air begin, which few markers will find in the liquid, in leaves.
    constexpr double outside_leaves = 0.25;

    template <int dim>
    std::vector<Point<dim>>
    owned_nodes(const Mesh<dim> &mesh)
    {
      return {mesh.node_position.begin(), mesh.node_position.begin() + mesh.n_owned_nodes()};
    }

    /// The faces that may carry liquid: a node of them is in it, or will be once markers have
    /// corrected phi.
    template <int dim>
    std::vector<LocalIndex>
    faces_that_matter(const State<dim> &state)
    {
      const Mesh<dim>        &mesh  = *state.mesh;
      const double            reach = 2 * mesh.surface_size();
      std::vector<LocalIndex> faces;
      for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
        if (std::any_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const auto node) {
              return state.phi.local_element(node) < reach;
            }))
          faces.push_back(f);
      return faces;
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
        divergence.emplace(old.phi, surface.level_set.gradients(), domain);
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
  typename Advection<dim>::Carried
  Advection<dim>::carried(std::vector<NodeField<dim>> fields,
                          const VelocityInStep<dim>  &velocity,
                          const double                dt,
                          const double                reach) const
  {
    Carried result{std::move(fields), {}};
    if (prm.scheme == Scheme::maccormack)
      {
        std::vector<const Vector *> values;
        for (const NodeField<dim> &field : result.fields)
          values.push_back(field.value);
        std::vector<LocalIndex> known, corrected;
        for (LocalIndex node = 0; node < old.mesh->n_owned_nodes(); ++node)
          {
            const double phi = old.phi.local_element(node);
            if (phi < reach)
              known.push_back(node);
            if (phi < 0) // fields in the air are not smooth
              corrected.push_back(node);
          }
        result.corrections =
          back_and_forth_error<dim>(*old.mesh, values, velocity, dt, known, corrected);
        for (unsigned int k = 0; k < result.fields.size(); ++k)
          result.fields[k].correction = &result.corrections[k];
      }
    return result;
  }

  template <int dim>
  State<dim>
  Advection<dim>::advance(std::shared_ptr<const Mesh<dim>> mesh,
                          const double                     reach,
                          const SurfaceMotion              motion) const
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
    advance_faces(state, reach);
    return state;
  }

  template <int dim>
  VelocityBefore<dim>
  Advection<dim>::velocity_before(const Mesh<dim> &mesh) const
  {
    VelocityBefore<dim> before{dt, at_nodes_of(mesh, old.v), {}};
    if (&mesh == old.mesh.get())
      before.u = missed_by_nodes(old, domain);
    return before;
  }

  template <int dim>
  void
  Advection<dim>::advance_nodes(State<dim> &state, const double reach) const
  {
    const Mesh<dim> &mesh = *state.mesh;
    PathEnds<dim>    ends = ends_in(mesh, velocity.surface[4]);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      ends.add_node(node);
    const std::vector<Point<dim>> from =
      Tracer<dim>(*old.mesh).trace(ends.x, velocity.surface, -dt, ends.cells, ends.velocity);
    const std::vector<double> values = surface.level_set.values(from, ends.cells);
    std::copy(values.begin(), values.end(), state.phi.begin());
    state.phi.update_ghost_values();
    if (!old.material)
      return;
    const Carried             carry = carried(
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

  template <int dim>
  typename Advection<dim>::Past
  Advection<dim>::past(Carried &&now, const double reach) const
  {
    const NodeVector<dim> &v = *old.before->v;
    return {std::move(now),
            carried(fields_of(v), velocity.carried[2], dt + old.before->dt, reach),
            combined(0.5, old.v, 0.5, v),
            {old, domain}};
  }

  template <int dim>
  typename Advection<dim>::Paths
  Advection<dim>::paths_to(PathEnds<dim> &&ends, const Carried &now) const
  {
    const Tracer<dim> tracer(*old.mesh);
    Paths             paths{tracer.trace(ends.x, velocity.carried, -dt, ends.cells, ends.velocity), {}, {}};
    paths.values = tracer.evaluate(paths.from, now.fields, ends.cells);
    paths.cells  = std::move(ends.cells);
    return paths;
  }

  template <int dim>
  std::vector<double>
  Advection<dim>::change_along(Paths &&paths, const Past &past) const
  {
    const Tracer<dim> tracer(*old.mesh);
    Guesses           cells   = paths.cells;
    const auto        further = tracer.trace(paths.from, past.between, -old.before->dt, paths.cells);
    const auto        before  = tracer.evaluate(further, past.before.fields, paths.cells);
    std::transform(
      paths.values.begin(), paths.values.end(), before.begin(), paths.values.begin(), std::minus<>());
    past.fall.set_change(paths.values, paths.from, cells, old.before->dt);
    return std::move(paths.values);
  }

  template <int dim>
  typename Advection<dim>::AtNodes
  Advection<dim>::at_nodes(const Carried                 &now,
                           const Past                    *past,
                           const Mesh<dim>               &mesh,
                           const std::vector<LocalIndex> &faces) const
  {
    Vector is_needed = mesh.zeros(mesh.nodes);
    for (const LocalIndex f : faces)
      for (const LocalIndex node : mesh.face_nodes[f])
        is_needed.local_element(node) = 1;
    is_needed.compress(VectorOperation::add);
    std::vector<LocalIndex> nodes;
    PathEnds<dim>           ends = ends_in(mesh, velocity.carried[4]);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (is_needed.local_element(node) > 0)
        {
          nodes.push_back(node);
          ends.add_node(node);
        }
    AtNodes    result{NodeVector<dim>(mesh.nodes), NodeVector<dim>(mesh.nodes)};
    const auto set = [&](NodeVector<dim> &v, const std::vector<double> &values) {
      for (unsigned int i = 0; i < values.size(); ++i)
        v.component[i % dim].local_element(nodes[i / dim]) = values[i];
      v.update_ghost_values();
    };
    Paths paths = paths_to(std::move(ends), now);
    set(result.now, paths.values);
    if (past != nullptr)
      set(result.change, change_along(std::move(paths), *past));
    return result;
  }

  template <int dim>
  void
  Advection<dim>::advance_faces(State<dim> &state, const double reach) const
  {
    const Mesh<dim>        &mesh  = *state.mesh;
    std::vector<LocalIndex> faces = faces_that_matter(state);
    // those of the air, then those whose nodes are all in the liquid, but not deep
    const auto first_with_nodes = [&](const auto begin, const double lowest, const double highest) {
      return std::stable_partition(begin, faces.end(), [&](const LocalIndex f) {
        return std::all_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const auto node) {
          return state.phi.local_element(node) > lowest && state.phi.local_element(node) <= highest;
        });
      });
    };
    const auto liquid = first_with_nodes(faces.begin(), outside_leaves * mesh.surface_size(), std::numeric_limits<double>::max());
    const auto deep   = first_with_nodes(liquid, -deep_leaves * mesh.surface_size(), 0);
    PathEnds<dim> ends = ends_in(mesh, velocity.carried[4]);
    std::for_each(liquid, faces.end(), [&](const LocalIndex f) { ends.add_face(f); });
    const auto add = [&](const auto begin, const double weight, const std::vector<double> &values) {
      for (unsigned int i = 0; i < values.size(); ++i)
        state.u.local_element(begin[i / dim]) += weight * mesh.face_normal[begin[i / dim]][i % dim] * values[i];
    };
    Carried now   = carried(fields_of(old.v), velocity.carried, dt, reach);
    Paths   paths = paths_to(std::move(ends), now);
    add(liquid, 1, paths.values);
    if (&mesh == old.mesh.get())
      keep_what_nodes_miss(old, domain, difference, faces, state.u);
    std::optional<Past> past;
    if (difference.before != 0)
      past.emplace(this->past(std::move(now), reach));
    const AtNodes nodes = past ? at_nodes(past->now, &*past, mesh, {faces.begin(), deep}) :
                                 at_nodes(now, nullptr, mesh, {faces.begin(), liquid});
    for (auto f = faces.begin(); f != liquid; ++f)
      state.u.local_element(*f) += face_velocity(mesh, nodes.now, *f);
    if (past)
      {
        for (auto f = faces.begin(); f != deep; ++f)
          state.u.local_element(*f) -= difference.before * face_velocity(mesh, nodes.change, *f);
        paths.drop(deep - liquid);
        add(deep, -difference.before, change_along(std::move(paths), *past));
      }
    state.u.update_ghost_values();
  }

  template class Advection<2>;
  template class Advection<3>;
} // namespace treacle
