// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_node.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/extrapolation.h>

namespace treacle
{
  template <int dim>
  void
  extrapolate(State<dim>                 &state,
              const LiquidDomain<dim>    &domain,
              const SurfaceGeometry<dim> &surface,
              const double                reach)
  {
    const Mesh<dim>            &mesh  = domain.mesh;
    const SurfaceDistance<dim> &facets = surface.distance(reach);

    std::vector<LocalIndex> nodes;
    std::vector<Point<dim>> sources;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (!domain.is_active_node[node])
        {
          state.v.set(node, Tensor<1, dim>());
          const double distance = std::abs(state.phi.local_element(node));
          if (distance >= reach)
            continue;
          const auto nearest = facets.nearest(mesh.node_position[node], distance);
          if (!std::isfinite(nearest.distance))
            continue;
          nodes.push_back(node);
          sources.push_back(nearest.point);
        }
    state.v.update_ghost_values();

    std::vector<NodeField<dim>> fields;
    for (const Vector &component : state.v.component)
      fields.push_back({&component});
    const std::vector<double> values = Tracer<dim>(mesh).evaluate(sources, fields);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        state.v.component[d].local_element(nodes[i]) = values[i * dim + d];
    set_prescribed(domain, state.v);

    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (!domain.is_liquid_face(f))
        state.u.local_element(f) = face_velocity(mesh, state.v, f);
    state.u.update_ghost_values();
  }

  template void
  extrapolate(State<2> &, const LiquidDomain<2> &, const SurfaceGeometry<2> &, const double);
  template void
  extrapolate(State<3> &, const LiquidDomain<3> &, const SurfaceGeometry<3> &, const double);
} // namespace treacle
