// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_node.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/extrapolation.h>

namespace treacle
{
  namespace
  {
    /// Nodes whose velocity is to be found, and where the surface is nearest to them.
    template <int dim>
    struct Extension
    {
      std::vector<LocalIndex> nodes;
      std::vector<Point<dim>> sources;
      Vector                  is_known; ///< 1 at all nodes whose velocity is not
    };

    /// All but those of the liquid; those that are too far away rest.
    template <int dim>
    Extension<dim>
    find_sources(State<dim>                 &state,
                 const LiquidDomain<dim>    &domain,
                 const SurfaceDistance<dim> &facets,
                 const double                reach)
    {
      const Mesh<dim> &mesh = domain.mesh;
      Extension<dim>   result{{}, {}, mesh.zeros(mesh.nodes)};
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (domain.is_active_node[node] && !domain.is_light_node[node])
          result.is_known.local_element(node) = 1;
        else
          {
            state.v.set(node, Tensor<1, dim>());
            const double distance = std::abs(state.phi.local_element(node));
            if (distance >= reach)
              continue;
            const auto nearest = facets.nearest(mesh.node_position[node], distance);
            if (!std::isfinite(nearest.distance))
              continue;
            result.nodes.push_back(node);
            result.sources.push_back(nearest.point);
          }
      state.v.update_ghost_values();
      result.is_known.update_ghost_values();
      return result;
    }
  } // namespace

  template <int dim>
  void
  extrapolate(State<dim>                 &state,
              const LiquidDomain<dim>    &domain,
              const SurfaceGeometry<dim> &surface,
              const double                reach)
  {
    const Mesh<dim>     &mesh = domain.mesh;
    const Extension<dim> extension =
      find_sources(state, domain, surface.distance(reach), reach);
    std::vector<NodeField<dim>> fields = fields_of(state.v);
    fields.push_back({&extension.is_known}); // the part of the point's cell that counts
    const std::vector<double> values = Tracer<dim>(mesh).evaluate(extension.sources, fields);
    constexpr double rounding = 1e-10; // of the part that counts: no node that the point has nothing of may have its say
    for (unsigned int i = 0; i < extension.nodes.size(); ++i)
      if (const double *value = &values[i * (dim + 1)]; value[dim] > rounding)
        for (unsigned int d = 0; d < dim; ++d)
          state.v.component[d].local_element(extension.nodes[i]) = value[d] / value[dim];
    // those of the liquid have what is prescribed, or slip
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (extension.is_known.local_element(node) == 0)
        set_prescribed(domain, node, state.v);
    state.v.update_ghost_values();

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
