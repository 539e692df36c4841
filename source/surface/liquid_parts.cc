// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/flood.h>
#include <treacle/fields/liquid_volume.h>
#include <treacle/fields/moved_points.h>
#include <treacle/fields/thin_liquid.h>
#include <treacle/geometry/cut_simplex.h>
#include <treacle/mesh/last_location.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/liquid_parts.h>
#include <treacle/surface/surface.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    constexpr double no_label = -1;

    /// Liquid is thick within so many layers of nodes of one that is deeper than that (leaves): the corners of a thick box are, sheets of
    /// three leaves are not. A trifle more than where nodes lie.
    constexpr double       deep      = 1.5001;
    constexpr unsigned int thickness = 3;

    /// Layers of nodes around a part that are moved with its surface, and of those that have no part of their own.
    constexpr unsigned int n_layers = 4;

    /// Of emitters, that they hold around them (leaves). A trifle less than where nodes lie.
    constexpr double held = 0.4999;

    /// What is thin about a body is a part of its own if it has more than so many times what is in the cells between them.
    constexpr double least_volume = 4;

    /// Area (m^(dim-1)) and centroid of what is outside solids of a facet of the surface in a cell.
    template <int dim>
    std::pair<double, Point<dim>>
    outside_solids(const std::array<Point<dim>, dim> &facet, const Simplex<dim> &cell, const VertexValues<dim> &solid_distance)
    {
      const double area = area_vector<dim>(facet).norm();
      if (*std::min_element(solid_distance.begin(), solid_distance.end()) > 0)
        return {area, std::accumulate(facet.begin() + 1, facet.end(), facet[0]) / dim};
      VertexValues<dim - 1> depth;
      for (unsigned int i = 0; i < dim; ++i)
        depth[i] = -interpolate(solid_distance, barycentric_coordinates<dim>(cell, facet[i]));
      return {area * negative_fraction<dim - 1>(depth), negative_centroid<dim>(facet, depth)};
    }
  } // namespace

  template <int dim>
  LiquidParts<dim>::LiquidParts(const MeshData<dim> &data, const Vector &phi, const double time)
    : data(data)
    , mesh(data.mesh)
    , time(time)
    , is_held(mesh.node_position.size(), 0)
  {
    find_held();
    Vector label = labels_of(phi, thick_nodes(phi));
    number(label);
    at_first = measures(phi);
    std::vector<bool> is_none(size() + 1, false);
    for (std::size_t k = 0; k < size(); ++k)
      is_none[k] = at_first.volume[k] < least_volume * at_first.shared[k];
    if (std::find(is_none.begin(), is_none.end(), true) == is_none.end())
      return;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (is_none[part[node]])
        label.local_element(node) = no_label;
    spread(label, phi);
    number(label);
    at_first = measures(phi);
  }

  template <int dim>
  void
  LiquidParts<dim>::find_held()
  {
    if (!data.scene.emitters().empty())
      for (LocalIndex node = 0; node < is_held.size(); ++node)
        is_held[node] = data.scene.emitter_distance(mesh.node_position[node], time) < held * mesh.finest_size();
  }

  template <int dim>
  Vector
  LiquidParts<dim>::thick_nodes(const Vector &phi) const
  {
    Vector is_thick(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      is_thick.local_element(node) = phi.local_element(node) < -deep * surface_size_at_node(mesh, node);
    return within_layers(data, phi, is_thick, thickness);
  }

  template <int dim>
  Vector
  LiquidParts<dim>::labels_of(const Vector &phi, const Vector &is_thick) const
  {
    const std::vector<double> &solid_distance = data.solid_distance(time);
    Vector                     label(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      label.local_element(node) = phi.local_element(node) < 0 && solid_distance[node] > 0 ?
                                    static_cast<double>(mesh.nodes->local_to_global(node)) :
                                    no_label;
    const auto alike = [&](const LocalIndex node, const auto &visit) {
      for (const auto &[other, n_cells] : data.neighbours(node))
        if (other != node && is_thick.local_element(other) == is_thick.local_element(node))
          visit(other);
    };
    Flood(label, alike).run();
    spread(label, phi);
    return label;
  }

  template <int dim>
  void
  LiquidParts<dim>::spread(Vector &label, const Vector &phi) const
  {
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        label.update_ghost_values();
        Vector next = label;
        next.zero_out_ghost_values();
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            if (label.local_element(node) != no_label)
              continue;
            double lowest = std::numeric_limits<double>::max();
            for (const auto &[other, n_cells] : data.neighbours(node))
              if (label.local_element(other) != no_label && phi.local_element(other) < lowest)
                {
                  lowest                   = phi.local_element(other);
                  next.local_element(node) = label.local_element(other);
                }
          }
        label = next;
      }
    label.update_ghost_values();
  }

  template <int dim>
  void
  LiquidParts<dim>::number(const Vector &label)
  {
    const auto unique = [](std::vector<double> &values) {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    };
    std::vector<double> here;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (label.local_element(node) != no_label)
        here.push_back(label.local_element(node));
    unique(here);
    labels.clear();
    for (const auto &of_rank : Utilities::MPI::all_gather(mesh.communicator(), here))
      labels.insert(labels.end(), of_rank.begin(), of_rank.end());
    unique(labels);
    part.resize(mesh.node_position.size());
    for (LocalIndex node = 0; node < part.size(); ++node)
      part[node] = label.local_element(node) == no_label ?
                     size() :
                     std::lower_bound(labels.begin(), labels.end(), label.local_element(node)) - labels.begin();
    if (size() == 1)
      std::fill(part.begin(), part.end(), 0);
  }

  template <int dim>
  template <typename Visit>
  void
  LiquidParts<dim>::share(const LocalIndex cell, const VertexValues<dim> &lambda, const Visit &visit) const
  {
    const auto &nodes = mesh.cell_nodes[cell];
    double      sum   = 0;
    for (unsigned int i = 0; i <= dim; ++i)
      if (part[nodes[i]] < size())
        sum += lambda[i];
    if (sum > 0)
      for (unsigned int i = 0; i <= dim; ++i)
        if (part[nodes[i]] < size())
          visit(part[nodes[i]], lambda[i] / sum);
  }

  template <int dim>
  bool
  LiquidParts<dim>::is_shared(const LocalIndex cell) const
  {
    std::size_t lowest = size(), highest = 0;
    for (const LocalIndex node : mesh.cell_nodes[cell])
      if (part[node] < size())
        {
          lowest  = std::min(lowest, part[node]);
          highest = std::max(highest, part[node]);
        }
    return lowest < highest;
  }

  template <int dim>
  typename LiquidParts<dim>::Measures
  LiquidParts<dim>::measures(const Vector &phi) const
  {
    const std::vector<double> &solid_distance = data.solid_distance(time);
    const std::vector<double>  zeros(size());
    Measures                   here{zeros, zeros, zeros}, all = here;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        if (!has_liquid(mesh, phi, c))
          continue;
        const Simplex<dim> x         = mesh.cell_vertices(c);
        const double       in_common = is_shared(c);
        if (const auto liquid = liquid_moments<dim>(x, mesh.values(c, phi), mesh.values(c, solid_distance)); liquid.volume > 0)
          share(c,
                barycentric_coordinates<dim>(x, Point<dim>(liquid.first / liquid.volume)),
                [&](const std::size_t k, const double fraction) {
                  here.volume[k] += fraction * liquid.volume;
                  here.shared[k] += in_common * fraction * liquid.volume;
                });
        for_each_facet(mesh, phi, c, [&](const std::array<Point<dim>, dim> &facet) {
          const auto [area, middle]      = outside_solids<dim>(facet, x, mesh.values(c, solid_distance));
          const VertexValues<dim> lambda = barycentric_coordinates<dim>(x, middle);
          for (unsigned int i = 0; i <= dim; ++i)
            if (const LocalIndex node = mesh.cell_nodes[c][i]; !is_held[node] && part[node] < size())
              here.area[part[node]] += lambda[i] * area;
        });
      }
    for (const auto member : {&Measures::volume, &Measures::area, &Measures::shared})
      Utilities::MPI::sum(here.*member, mesh.communicator(), all.*member);
    return all;
  }

  template <int dim>
  std::vector<double>
  LiquidParts<dim>::received(const std::vector<Parcel<dim>> &parcels) const
  {
    std::vector<Parcel<dim>> inside = parcels;
    clamp(mesh, inside);
    std::vector<double> here(size()), all(size());
    LastLocation<dim>   last(mesh);
    for (const Parcel<dim> &parcel : to_owners(mesh, inside))
      {
        const Location<dim> place = mesh.locator().locate_here(parcel.position, last.guess(parcel.position));
        last.set(parcel.position, place.cell);
        if (place.cell != invalid)
          share(place.cell, place.lambda, [&](const std::size_t k, const double fraction) {
            here[k] += fraction * parcel.volume;
          });
      }
    Utilities::MPI::sum(here, mesh.communicator(), all);
    return all;
  }

  template <int dim>
  std::vector<double>
  LiquidParts<dim>::at(const std::vector<Point<dim>> &x, const std::vector<double> &of_parts) const
  {
    if (size() == 1 && data.scene.emitters().empty())
      return std::vector<double>(x.size(), of_parts[0]);
    Vector value(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      value.local_element(node) = at_node(node, of_parts);
    value.update_ghost_values();
    return Tracer<dim>(mesh).evaluate(x, {{&value}});
  }

  template class LiquidParts<2>;
  template class LiquidParts<3>;
} // namespace treacle
