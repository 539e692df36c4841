// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/transport/free_fall.h>

namespace treacle
{
  template <int dim>
  FreeFall<dim>::FreeFall(const State<dim> &state, const LiquidDomain<dim> &domain)
    : domain(domain)
    , time(state.time)
    , held(domain.mesh.zeros(domain.mesh.nodes))
  {
    const Mesh<dim> &mesh    = domain.mesh;
    const auto       phi     = [&](const LocalIndex node) { return state.phi.local_element(node); };
    const auto       is_far  = [&](const LocalIndex node) { return std::abs(phi(node)) >= mesh.surface_size(); };
    Vector           is_deep = held;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double &value = is_deep.local_element(node);
        value         = domain.constrained[node] != 0 || (is_far(node) && phi(node) < 0);
        if (value != 0 || is_far(node))
          continue;
        const double deep = -0.5 * surface_size_at_node(mesh, node);
        value = phi(node) < -2 * deep &&
                any_around(domain.data, node, [&](const auto other) { return phi(other) <= deep; });
      }
    is_deep.update_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      held.local_element(node) = // what is far is deep, or air about nothing
        is_far(node) || phi(node) >= surface_size_at_node(mesh, node) ||
        any_around(domain.data, node, [&](const auto other) { return is_deep.local_element(other) > 0; });
    held.update_ghost_values();
  }

  template <int dim>
  void
  FreeFall<dim>::set_change(std::vector<double>           &change,
                            const std::vector<Point<dim>> &x,
                            Guesses                       &cells,
                            const double                   dt) const
  {
    const std::vector<double> is_held = Tracer<dim>(domain.mesh).evaluate(x, {{&held}}, cells);
    std::string               error;
    keep_error(error, [&] {
      for (unsigned int i = 0; i < x.size(); ++i)
        if (is_held[i] == 0)
          {
            const Tensor<1, dim> g = domain.scene.gravity(x[i], time);
            for (unsigned int d = 0; d < dim; ++d)
              change[dim * i + d] = dt * g[d];
          }
    });
    throw_first(domain.mesh.communicator(), error);
  }

  template class FreeFall<2>;
  template class FreeFall<3>;
} // namespace treacle
