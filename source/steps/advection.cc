// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/mapping.h>
#include <treacle/mesh/tracer.h>
#include <treacle/steps/advection.h>
#include <treacle/steps/back_and_forth.h>
#include <treacle/steps/redistance.h>

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
        free.local_element(node) = domain.constrained[node] == 0;
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
                          "How velocity is carried along: MacCormack's correction keeps more of "
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
    , phi_gradient(nodal_gradient(*old.mesh, old.phi))
    , phi_smoothness(old.mesh->nodes)
  {
    // at kinks the mean over the cells around is shorter than 1
    for (LocalIndex node = 0; node < old.mesh->n_owned_nodes(); ++node)
      phi_smoothness.local_element(node) = std::abs(phi_gradient.value(node).norm() - 1) < 0.1;
    phi_smoothness.update_ghost_values();
  }

  template <int dim>
  std::vector<Point<dim>>
  Advection<dim>::move_surface(const std::vector<Point<dim>> &x, const double dt) const
  {
    return Tracer<dim>(*old.mesh).trace(x, surface_velocity, dt);
  }

  template <int dim>
  std::vector<double>
  Advection<dim>::level_set(const std::vector<Point<dim>> &x, const double dt) const
  {
    const Tracer<dim> tracer(*old.mesh);
    return tracer.evaluate(tracer.trace(x, surface_velocity, -dt), {{&old.phi, &phi_gradient, &phi_smoothness}});
  }

  template <int dim>
  std::vector<Vector>
  Advection<dim>::velocity_correction(const double dt, const double reach) const
  {
    if (prm.scheme == "semi-Lagrangian")
      return {};
    std::vector<LocalIndex> known, corrected;
    for (LocalIndex node = 0; node < old.mesh->n_owned_nodes(); ++node)
      {
        const double phi = old.phi.local_element(node);
        if (phi < reach)
          known.push_back(node);
        if (phi < 0) // the velocity in the air is not smooth
          corrected.push_back(node);
      }
    std::vector<const Vector *> components;
    for (const Vector &component : old.v.component)
      components.push_back(&component);
    return back_and_forth_error(*old.mesh, components, old.v, dt, known, corrected);
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

    std::vector<Point<dim>> x(mesh->node_position.begin(),
                              mesh->node_position.begin() + mesh->n_owned_nodes());
    const std::vector<double> phi = level_set(x, dt);
    std::copy(phi.begin(), phi.end(), state.phi.begin());
    state.phi.update_ghost_values();

    std::vector<LocalIndex> faces;
    x.clear();
    for (LocalIndex f = 0; f < mesh->n_owned_faces(); ++f)
      if (std::any_of(mesh->face_nodes[f].begin(), mesh->face_nodes[f].end(), [&](const auto node) {
            return state.phi.local_element(node) < reach;
          }))
        {
          faces.push_back(f);
          x.push_back(mesh->face_centre[f]);
        }
    const Tracer<dim>           tracer(*old.mesh);
    const std::vector<Vector>   correction = velocity_correction(dt, reach);
    std::vector<NodeField<dim>> fields;
    for (unsigned int d = 0; d < dim; ++d)
      fields.push_back({&old.v.component[d],
                        nullptr,
                        nullptr,
                        correction.empty() ? nullptr : &correction[d]});
    const std::vector<double> v = tracer.evaluate(tracer.trace(x, old.v, -dt), fields);
    for (unsigned int i = 0; i < faces.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        state.u.local_element(faces[i]) += mesh->face_normal[faces[i]][d] * v[dim * i + d];
    state.u.update_ghost_values();
    return state;
  }

  template class Advection<2>;
  template class Advection<3>;
} // namespace treacle
