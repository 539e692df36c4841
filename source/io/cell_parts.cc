// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/io/cell_parts.h>

namespace treacle
{
  template <int dim>
  CellParts<dim>::CellParts(const State<dim> &state, const LiquidDomain<dim> &domain)
    : state(state)
    , domain(domain)
    , mesh(*state.mesh)
    , films(state)
  {}

  template <int dim>
  void
  CellParts<dim>::for_each_part(const LocalIndex cell, const std::function<void(const Simplex &)> &visit)
  {
    const auto &nodes      = mesh.cell_nodes[cell];
    const auto  is_near    = [&](const LocalIndex node) { return films.is_near(node); };
    const auto  has_liquid = [&](const LocalIndex node) { return films.phi_at(node) < 0; };
    const bool  may_divide = std::any_of(nodes.begin(), nodes.end(), is_near);
    if (!may_divide && std::none_of(nodes.begin(), nodes.end(), has_liquid))
      return;
    Simplex simplex;
    std::transform(nodes.begin(), nodes.end(), simplex.begin(), [&](const LocalIndex node) {
      return corner(node);
    });
    if (may_divide)
      divide(simplex, visit);
    else
      visit(simplex);
  }

  template <int dim>
  typename CellParts<dim>::Corner
  CellParts<dim>::corner(const LocalIndex node) const
  {
    const double    solid = -domain.solid_distance[node];
    const VertexKey key   = mesh.node_key[node];
    return {{{node, node}},
            {{key, key, 0}},
            mesh.node_position[node],
            state.v.value(node),
            films.phi_at(node),
            // a solid on a lattice plane
            std::abs(solid) < 1e-9 * mesh.finest_size() ? 0 : solid};
  }

  template <int dim>
  std::optional<typename CellParts<dim>::Between>
  CellParts<dim>::between(const Simplex &simplex, const unsigned int i, const unsigned int j)
  {
    const Corner             &a = simplex[i], &b = simplex[j];
    std::array<LocalIndex, 2> ends = a.is_node() ? b.ends : a.ends;
    if (a.is_node() && b.is_node())
      {
        ends = {{a.ends[0], b.ends[0]}};
        if (a.key[0] > b.key[0])
          std::swap(ends[0], ends[1]);
      }
    VertexKey sum = 0; // of parts
    for (const Corner *c : {&a, &b})
      if (c->ends == ends)
        sum += c->key[2];
      else if (!c->is_node() || (c->ends[0] != ends[0] && c->ends[0] != ends[1]))
        return {};
      else if (c->ends[0] == ends[1])
        sum += Films<dim>::n_parts;
    const auto &edge = films.edge(ends[0], ends[1]);
    if (sum % 2 == 1 || !edge.is_cut[sum / 2])
      return {};
    const std::int64_t sixteenths = std::lround(16 * a.x.distance(b.x) / mesh.finest_size());
    return {{{-sixteenths, mesh.node_key[ends[0]], mesh.node_key[ends[1]], sum / 2}, {{i, j}}, ends, edge.phi[sum / 2]}};
  }

  template <int dim>
  void
  CellParts<dim>::divide(const Simplex &simplex, const std::function<void(const Simplex &)> &visit)
  {
    std::optional<Between> first;
    for (unsigned int i = 0; i <= dim; ++i)
      for (unsigned int j = 0; j < i; ++j)
        if (const auto at = between(simplex, i, j); at && (!first || at->place < first->place))
          first = at;
    if (!first)
      return visit(simplex);
    const Corner &a = simplex[first->corners[0]], &b = simplex[first->corners[1]];
    const auto   &[length, key, other_key, part] = first->place;
    const Corner  middle{first->ends,
                         {{key, other_key, part}},
                         a.x + 0.5 * (b.x - a.x),
                         0.5 * (a.v + b.v),
                         first->phi,
                         0.5 * (a.solid + b.solid)};
    for (const unsigned int k : first->corners)
      {
        Simplex half = simplex;
        half[k]      = middle;
        divide(half, visit);
      }
  }

  template class CellParts<2>;
  template class CellParts<3>;
} // namespace treacle
