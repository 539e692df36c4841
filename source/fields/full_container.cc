// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/full_container.h>
#include <treacle/geometry/cut_simplex.h>

namespace treacle
{
  template <int dim>
  Inflow
  inflow_into(const LiquidDomain<dim> &domain, const std::vector<LocalIndex> &cells)
  {
    std::array<double, 2> inflow{};
    for (const LocalIndex c : cells)
      {
        const auto  &nodes = domain.mesh.cell_nodes[c];
        const double here  = -domain.closed_outflow(c);
        inflow[0] += here;
        if (std::any_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) { return domain.is_emitter_node[node]; }))
          inflow[1] += std::abs(here);
      }
    Utilities::MPI::sum(
      ArrayView<const double>(inflow.data(), 2), domain.mesh.communicator(), ArrayView<double>(inflow.data(), 2));
    return {inflow[0], inflow[1]};
  }

  template <int dim>
  bool
  has_free_surface(const LiquidDomain<dim> &domain, const LocalIndex cell)
  {
    for (const LocalIndex f : domain.mesh.cell_faces[cell])
      for (const LocalIndex other : domain.mesh.face_cells[f])
        if (other != invalid && domain.is_liquid_face(f) && !domain.is_pressure_cell[other])
          return true;
    return false;
  }

  namespace
  {
    template <int dim>
    std::vector<LocalIndex>
    wet_cells(const LiquidDomain<dim> &domain)
    {
      std::vector<LocalIndex> cells;
      for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
        if (domain.is_pressure_cell[c])
          cells.push_back(c);
      return cells;
    }

    /// m^dim.
    template <int dim>
    double
    air_outside_solids(const LiquidDomain<dim> &domain)
    {
      VertexValues<dim> full;
      full.fill(-1);
      double volume = 0;
      for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
        {
          const auto distance = domain.mesh.values(c, domain.solid_distance);
          const auto [low, high] = std::minmax_element(distance.begin(), distance.end());
          if (*high > 0)
            volume += (*low > 0 ? domain.mesh.cell_volume[c] :
                                  liquid_moments<dim>(domain.mesh.cell_vertices(c), full, distance).volume) -
                      domain.liquid_volume[c];
        }
      return Utilities::MPI::sum(volume, domain.mesh.communicator());
    }
  } // namespace

  template <int dim>
  Room
  room(const LiquidDomain<dim> &domain, const double missing)
  {
    constexpr double little = 0.25, rounding = 1e-9; // of the liquid's volume
    const Mesh<dim> &mesh   = domain.mesh;
    if (domain.scene.emitters().empty() || domain.emitters_rest)
      return {};
    const double left = air_outside_solids(domain) - std::max(0., missing),
                 air  = left > rounding * domain.total_volume() ? left : 0;
    if (air > little * domain.total_volume())
      return {air, 0};
    double fastest = 0; // m/s
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (domain.is_emitter_node[node])
        fastest = std::max(fastest, domain.prescribed[node].norm());
    fastest = Utilities::MPI::max(fastest, mesh.communicator());
    return {air, fastest > 0 ? mesh.finest_size() * inflow_into(domain, wet_cells(domain)).at_emitters / fastest : 0};
  }

  template <int dim>
  bool
  is_full(const LiquidDomain<dim> &domain)
  {
    if (domain.scene.emitters().empty())
      return false;
    const Room space   = room(domain);
    const auto cells   = wet_cells(domain);
    const bool is_open = Utilities::MPI::logical_or(
      std::any_of(cells.begin(), cells.end(), [&](const LocalIndex c) { return has_free_surface(domain, c); }),
      domain.mesh.communicator());
    return (!is_open || space.air < space.layer) && inflow_into(domain, cells).is_too_much();
  }

  template <int dim>
  std::shared_ptr<const LiquidDomain<dim>>
  liquid_domain_of(const typename LiquidDomain<dim>::Parameters &parameters, const State<dim> &state, const MeshData<dim> &data)
  {
    auto domain = std::make_shared<const LiquidDomain<dim>>(parameters, state, data);
    return is_full(*domain) ? std::make_shared<const LiquidDomain<dim>>(parameters, state, data, true) : domain;
  }

#define INSTANTIATE(dim)                                                                   \
  template Inflow inflow_into(const LiquidDomain<dim> &, const std::vector<LocalIndex> &); \
  template bool   has_free_surface(const LiquidDomain<dim> &, const LocalIndex);           \
  template bool   is_full(const LiquidDomain<dim> &);                                      \
  template Room   room(const LiquidDomain<dim> &, const double);                           \
  template std::shared_ptr<const LiquidDomain<dim>> liquid_domain_of(                      \
    const LiquidDomain<dim>::Parameters &, const State<dim> &, const MeshData<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
