// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/surface_size.h>
#include <treacle/surface/films.h>
#include <treacle/surface/marker_distance.h>

namespace treacle
{
  template <int dim>
  Films<dim>::Films(const State<dim> &state)
    : mesh(*state.mesh)
    , markers(mesh, state.markers, MarkerSheet<dim>::reach)
    , phi(state.phi)
    , near(mesh.nodes)
  {
    phi.zero_out_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double &value = phi.local_element(node);
        if (std::abs(value) > ThinPart::deep * largest_surface_size(mesh))
          continue;
        if (const auto in_film = phi_in_film(mesh.node_position[node], value, surface_size_at_node(mesh, node)))
          {
            near.local_element(node) = 1;
            value                    = *in_film;
          }
      }
    phi.update_ghost_values();
    near.update_ghost_values();
  }

  template <int dim>
  std::optional<double>
  Films<dim>::phi_in_film(const Point<dim> &x, const double old, const double size) const
  {
    static thread_local std::vector<const NearMarker<dim> *> about;
    about.clear();
    markers.append_around(x, size, about);
    if (about.empty())
      return {};
    return corrected_in_film<dim>(x, old, view<dim>(about), nearest<dim>(x, view<dim>(about)), size);
  }

  template <int dim>
  const typename Films<dim>::Edge &
  Films<dim>::edge(const LocalIndex first, const LocalIndex second)
  {
    static const Edge none;
    if (!is_near(first) && !is_near(second))
      return none;
    const auto [it, is_new] = edges.emplace(std::make_pair(first, second), Edge());
    if (is_new)
      measure(it->second, first, second);
    return it->second;
  }

  template <int dim>
  void
  Films<dim>::measure(Edge &edge, const LocalIndex first, const LocalIndex second) const
  {
    const Point<dim>    &x      = mesh.node_position[first];
    const Tensor<1, dim> way    = mesh.node_position[second] - x;
    const double         length = way.norm(), a = phi_at(first), b = phi_at(second);
    if ((a < 0) == (b < 0) && std::min(std::abs(a), std::abs(b)) >= 0.5 * length)
      return; // no surface is so near
    double size = mesh.finest_size(); // of leaves
    while (size < 0.99 * length && size < 0.99 * largest_surface_size(mesh))
      size *= 2;
    edge.phi[0]       = a;
    edge.phi[n_parts] = b;
    for (unsigned int step = n_parts / 2; step > 0; step /= 2)
      for (unsigned int k = step; k < n_parts; k += 2 * step)
        {
          const double before = edge.phi[k - step], after = edge.phi[k + step], old = 0.5 * (before + after);
          edge.phi[k] = phi_in_film(x + double(k) / n_parts * way, old, size).value_or(old);
          if (std::min({before, edge.phi[k], after}) < 0 && std::max({before, edge.phi[k], after}) >= 0)
            edge.is_cut[k] = edge.is_cut[n_parts / 2] = true; // halves come first
        }
  }

  template class Films<2>;
  template class Films<3>;
} // namespace treacle
