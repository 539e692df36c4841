// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/mapping.h>
#include <treacle/mesh/tracer.h>
#include <treacle/steps/advection.h>
#include <treacle/steps/back_and_forth.h>
#include <treacle/steps/marker_correction.h>

namespace treacle
{
  namespace
  {
    /// Replace the prescribed components of the velocity by the mean over free nodes of
    /// the cells around them, layer by layer.
    template <int dim>
    NodeVector<dim>
    slipping_velocity(const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      const Mesh<dim>  &mesh = domain.mesh;
      NodeVector<dim> v    = state.v;
      Vector            free = mesh.zeros(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        free.local_element(node) =
          domain.constrained[node] == 0 || domain.is_emitter_node[node];
      for (unsigned int layer = 0; layer < 3; ++layer)
        {
          free.update_ghost_values();
          v.update_ghost_values();
          const NodeVector<dim> known = v;
          known.update_ghost_values();
          const Vector was_free = free;
          was_free.update_ghost_values();
          Tensor<1, dim> mean;
          for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
            {
              if (was_free.local_element(node) > 0 ||
                  !mean_of_neighbours(mesh, known, was_free, node, mean))
                continue;
              for (unsigned int d = 0; d < dim; ++d)
                if (domain.constrained[node] >> d & 1)
                  v.component[d].local_element(node) = mean[d];
              free.local_element(node) = 1;
            }
        }
      v.update_ghost_values();
      return v;
    }
  } // namespace

  template <int dim>
  void
  Advection<dim>::Parameters::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Advection");
    handler.add_parameter("Scheme",
                          scheme,
                          "How velocity and material are carried along: MacCormack's correction keeps more of "
                          "what is small, at about twice the work.",
                          Patterns::Selection("semi-Lagrangian|MacCormack"));
    handler.leave_subsection();
  }

  template <int dim>
  Advection<dim>::Advection(const Parameters        &parameters,
                            const State<dim>        &old,
                            const LiquidDomain<dim> &domain)
    : prm(parameters)
    , old(old)
    , surface_velocity(slipping_velocity(old, domain))
    , phi(*old.mesh, old.phi)
  {}

  template <int dim>
  std::vector<Point<dim>>
  Advection<dim>::move_surface(const std::vector<Point<dim>> &x, const double dt) const
  {
    return Tracer<dim>(*old.mesh).trace(x, surface_velocity, dt);
  }

  template <int dim>
  std::vector<Marker<dim>>
  Advection<dim>::move_markers(const double dt) const
  {
    return moved_markers(old, surface_velocity, dt);
  }

  template <int dim>
  std::vector<double>
  Advection<dim>::level_set(const std::vector<Point<dim>> &x, const double dt) const
  {
    return phi.values(Tracer<dim>(*old.mesh).trace(x, surface_velocity, -dt));
  }

  template <int dim>
  std::vector<double>
  Advection<dim>::carried(const std::vector<const Vector *> &fields,
                          const NodeVector<dim>             &velocity,
                          const std::vector<Point<dim>>     &from,
                          const double                       dt,
                          const double                       reach) const
  {
    std::vector<NodeField<dim>> node_fields;
    for (const Vector *field : fields)
      node_fields.push_back({field});
    std::vector<Vector> correction;
    if (prm.scheme == "MacCormack")
      {
        std::vector<LocalIndex> known, corrected;
        for (LocalIndex node = 0; node < old.mesh->n_owned_nodes(); ++node)
          {
            const double phi = old.phi.local_element(node);
            if (phi < reach)
              known.push_back(node);
            if (phi < 0) // fields in the air are not smooth
              corrected.push_back(node);
          }
        correction = back_and_forth_error(*old.mesh, fields, velocity, dt, known, corrected);
        for (unsigned int k = 0; k < fields.size(); ++k)
          node_fields[k].correction = &correction[k];
      }
    return Tracer<dim>(*old.mesh).evaluate(from, node_fields);
  }

  template <int dim>
  State<dim>
  Advection<dim>::advance(std::shared_ptr<const Mesh<dim>> mesh,
                          const double                     dt,
                          const double                     reach) const
  {
    State<dim> state(mesh);
    state.time = old.time + dt;
    state.step = old.step + 1;
    if (mesh == old.mesh)
      state.pressure = old.pressure;
    state.pressure.update_ghost_values();
    advance_nodes(state, dt, reach);
    advance_faces(state, dt, reach);
    return state;
  }

  template <int dim>
  void
  Advection<dim>::advance_nodes(State<dim> &state, const double dt, const double reach) const
  {
    const Mesh<dim>              &mesh = *state.mesh;
    const std::vector<Point<dim>> x(mesh.node_position.begin(),
                                    mesh.node_position.begin() + mesh.n_owned_nodes());
    const Tracer<dim>             tracer(*old.mesh);
    const std::vector<Point<dim>> from = tracer.trace(x, surface_velocity, -dt);
    const std::vector<double>     values = phi.values(from);
    std::copy(values.begin(), values.end(), state.phi.begin());
    state.phi.update_ghost_values();
    if (!old.material)
      return;
    const std::vector<double> material =
      carried({&old.material->density, &old.material->viscosity}, surface_velocity, from, dt, reach);
    state.material.emplace(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        state.material->density.local_element(node)   = material[2 * node];
        state.material->viscosity.local_element(node) = material[2 * node + 1];
      }
    state.material->update_ghost_values();
  }

  template <int dim>
  void
  Advection<dim>::advance_faces(State<dim> &state, const double dt, const double reach) const
  {
    const Mesh<dim>        &mesh = *state.mesh;
    std::vector<LocalIndex> faces;
    std::vector<Point<dim>> x;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (std::any_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const auto node) {
            return state.phi.local_element(node) < reach;
          }))
        {
          faces.push_back(f);
          x.push_back(mesh.face_centre[f]);
        }
    std::vector<const Vector *> components;
    for (const Vector &component : old.v.component)
      components.push_back(&component);
    const std::vector<double> v =
      carried(components, old.v, Tracer<dim>(*old.mesh).trace(x, old.v, -dt), dt, reach);
    for (unsigned int i = 0; i < faces.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        state.u.local_element(faces[i]) += mesh.face_normal[faces[i]][d] * v[dim * i + d];
    state.u.update_ghost_values();
  }

  template class Advection<2>;
  template class Advection<3>;
} // namespace treacle
