// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/flood.h>
#include <treacle/geometry/cut_simplex.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/air_pockets.h>
#include <treacle/surface/surface_distance.h>

#include <map>
#include <set>

namespace treacle
{
  namespace
  {
    /// Of its volume, that may fill in a step of what is thin: whose volume over the area of its surface is less than half a
    /// leaf, as that of a sheet of a leaf, a disc of two, a ball of three across. What is larger is seen to shrink. What is gained
    /// of what closes now, and lost of what closes a step later, are as much in the mean.
    constexpr double most_filled = 0.5, thin = 0.5;

    /// Part of the volume that moves in or out by roundoff, as in a body that moves as a rigid one.
    constexpr double noise = 0.01;

    /// From the surface (leaves): air that goes on further is not looked at.
    constexpr double deep = 2;

    /// The label of such air, and of what is at solids, which cut its volume and its surface.
    constexpr double open = 0;

    /// A part of the air that is connected.
    struct AirPart
    {
      double volume = 0; ///< (m^dim)
      double inflow = 0; ///< of liquid (m^dim/s)
      double area   = 0; ///< of the surface of liquid about it (m^(dim-1))
      double size   = 0; ///< edge of the smallest leaf (m)

      void
      add(const AirPart &other)
      {
        volume += other.volume;
        inflow += other.inflow;
        area += other.area;
        size = size == 0 ? other.size : std::min(size, other.size);
      }

      bool
      is_thin() const
      {
        return volume < thin * size * area;
      }

      /// Part of it in a step.
      double
      filled(const double dt) const
      {
        return dt * inflow / volume;
      }

      /// What is smaller than a leaf may have met the liquid in this step, and its velocity does not know, only that it does
      /// not open.
      bool
      is_filled_within(const double dt, const unsigned int dim) const
      {
        return is_thin() &&
               (filled(dt) > most_filled || (filled(dt) > -noise && volume < std::pow(size, dim)));
      }
    };

    /// Are two P1 functions positive somewhere together, in a simplex of n vertices? If so, on an edge.
    template <std::size_t n>
    bool
    are_positive(const std::array<double, n> &a, const std::array<double, n> &b)
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
          {
            const double at_i = a[i] - b[i], at_j = a[j] - b[j];
            const double t    = at_i * at_j < 0 ? at_i / (at_i - at_j) : 0.;
            if (std::min((1 - t) * a[i] + t * a[j], (1 - t) * b[i] + t * b[j]) > 0)
              return true;
          }
      return false;
    }

    template <int dim>
    class AirParts
    {
    public:
      /// Collective.
      AirParts(const State<dim> &state, const MeshData<dim> &data)
        : state(state)
        , mesh(data.mesh)
        , from_solid(data.solid_distance(state.time))
        , label(mesh.cells)
      {
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          label.local_element(c) = first_label(c);
        const auto neighbours = [this](const LocalIndex c, const auto &visit) {
          for (const LocalIndex f : mesh.cell_faces[c])
            if (const auto &[lower, upper] = mesh.face_cells[f];
                upper != invalid && has_air(mesh.face_nodes[f]))
              visit(lower == c ? upper : lower);
        };
        Flood(label, neighbours).run();
      }

      /// The labels of the parts that a step fills. Collective.
      std::set<double>
      filled_within(const double dt) const
      {
        std::set<double> result;
        for (const auto &[l, part] : sums())
          if (part.is_filled_within(dt, dim))
            result.insert(l);
        return result;
      }

      /// Is it an owned node of the air about which there are only these?
      bool
      is_node_of(const LocalIndex node, const std::set<double> &parts) const
      {
        if (state.phi.local_element(node) < 0)
          return false;
        bool is_beside = false;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          if (const double l = label.local_element(mesh.node_cells[k]); l >= 0)
            {
              if (parts.count(l) == 0)
                return false;
              is_beside = true;
            }
        return is_beside;
      }

      /// Is it an owned node in a gap between liquid, open elsewhere, that a step fills? All nodes around it are near the
      /// surface then, and the gap is what is in their cells.
      bool
      is_in_gap_filled_within(const LocalIndex node, const double dt) const
      {
        const double near    = thin * surface_size_at_node(mesh, node);
        const auto   is_near = [&](const LocalIndex i) { return state.phi.local_element(i) < near; };
        if (state.phi.local_element(node) < 0 || !is_near(node) || mesh.node_sides[node] != 0)
          return false;
        AirPart gap;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          {
            const LocalIndex c     = mesh.node_cells[k];
            const auto      &nodes = mesh.cell_nodes[c];
            if (is_at_solid(c) || !std::all_of(nodes.begin(), nodes.end(), is_near))
              return false;
            gap.add(in_cell(c));
          }
        return gap.is_thin() && gap.filled(dt) > most_filled;
      }

    private:
      /// Of its own where the cell has air, but none in the middle of the air.
      double
      first_label(const LocalIndex c) const
      {
        const VertexValues<dim> phi     = mesh.values(c, state.phi);
        const auto [lowest, highest]    = std::minmax_element(phi.begin(), phi.end());
        const double            farther = deep * largest_surface_size(mesh);
        if (*lowest > farther || !has_air(mesh.cell_nodes[c]))
          return -1;
        return *highest > farther || is_at_solid(c) ? open : 1. + mesh.cells->local_to_global(c);
      }

      /// Of a cell or a face.
      template <std::size_t n>
      bool
      has_air(const std::array<LocalIndex, n> &nodes) const
      {
        std::array<double, n> phi, psi;
        for (unsigned int i = 0; i < n; ++i)
          {
            phi[i] = state.phi.local_element(nodes[i]);
            psi[i] = from_solid[nodes[i]];
          }
        return are_positive(phi, psi);
      }

      /// Of all parts, by label. Collective.
      std::map<double, AirPart>
      sums() const
      {
        std::map<double, AirPart> here, all;
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          if (const double l = label.local_element(c); l > open)
            here[l].add(in_cell(c));
        std::vector<std::array<double, 5>> packed;
        for (const auto &[l, p] : here)
          packed.push_back({{l, p.volume, p.inflow, p.area, p.size}});
        for (const auto &rank : Utilities::MPI::all_gather(mesh.communicator(), packed))
          for (const auto &[l, volume, inflow, area, size] : rank)
            all[l].add(AirPart{volume, inflow, area, size});
        return all;
      }

      AirPart
      in_cell(const LocalIndex c) const
      {
        VertexValues<dim> air = mesh.values(c, state.phi);
        for (double &value : air)
          value = -value;
        AirPart result{negative_fraction<dim>(air) * mesh.cell_volume[c], 0, 0, surface_size_of_cell(mesh, c)};
        Tensor<1, dim> outward;
        for_each_facet(mesh, state.phi, c, [&](const std::array<Point<dim>, dim> &x) {
          outward += area_vector<dim>(x);
          result.area += area_vector<dim>(x).norm();
        });
        if (result.area > 0)
          result.inflow = outward * velocity_of_liquid(c);
        return result;
      }

      /// Is a node in one?
      bool
      is_at_solid(const LocalIndex c) const
      {
        const auto &nodes = mesh.cell_nodes[c];
        return std::any_of(
          nodes.begin(), nodes.end(), [&](const LocalIndex node) { return from_solid[node] <= 0; });
      }

      /// Of its liquid: that of the nodes of the air beside it is of one side of a gap, or in between.
      Tensor<1, dim>
      velocity_of_liquid(const LocalIndex c) const
      {
        Tensor<1, dim> v;
        unsigned int   n = 0;
        for (const LocalIndex node : mesh.cell_nodes[c])
          if (state.phi.local_element(node) < 0)
            {
              v += state.v.value(node);
              ++n;
            }
        return v / n;
      }

      const State<dim>          &state;
      const Mesh<dim>           &mesh;
      const std::vector<double> &from_solid;
      Vector                     label; ///< of a cell's air; negative without any, and deep in it
    };

    /// The facets of one surface that another of the same mesh is without.
    template <int dim>
    Surface<dim>
    difference(const Surface<dim> &surface, const Vector &phi)
    {
      Surface<dim> result = surface;
      result.facets.clear();
      for (const auto &facet : surface.facets)
        {
          const bool is_gone = std::all_of(facet.begin(), facet.end(), [&](const unsigned int i) {
            const auto &vertex = surface.vertices[i];
            return phi.local_element(vertex.a) < 0 && phi.local_element(vertex.b) < 0;
          });
          if (is_gone)
            result.facets.push_back(facet);
        }
      return result;
    }
  } // namespace

  template <int dim>
  void
  close_air_pockets(State<dim> &state, const MeshData<dim> &data, const double dt, const double reach)
  {
    const Mesh<dim>        &mesh = data.mesh;
    const AirParts<dim>     air(state, data);
    const std::set<double> closed = air.filled_within(dt);
    Vector                 phi  = state.phi;
    bool                   any  = false;
    phi.zero_out_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (air.is_node_of(node, closed) || air.is_in_gap_filled_within(node, dt))
        {
          phi.local_element(node) = -reach;
          any                     = true;
        }
    if (Utilities::MPI::max(any ? 1 : 0, mesh.communicator()) == 0)
      return;
    phi.update_ghost_values();
    const SurfaceDistance<dim> kept(mesh, extract_surface(mesh, phi), reach),
      gone(mesh, difference(extract_surface(mesh, state.phi), phi), reach);
    const double leaf       = largest_surface_size(mesh); // no marker is further from its surface
    const auto   was_nearer = [&](const Point<dim> &x) {
      const double to_gone = gone.nearest(x).distance;
      return to_gone < reach && !kept.is_any_within(x, to_gone);
    };
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (double &value = phi.local_element(node); value < 0 && was_nearer(mesh.node_position[node]))
        value = -std::min(reach, kept.nearest(mesh.node_position[node]).distance);
    phi.update_ghost_values();
    state.phi = phi;
    state.phi.update_ghost_values();
    state.markers.erase(std::remove_if(state.markers.begin(),
                                       state.markers.end(),
                                       [&](const Marker<dim> &marker) {
                                         return gone.is_any_within(marker.position, leaf) &&
                                                was_nearer(marker.position);
                                       }),
                        state.markers.end());
  }

  template void
  close_air_pockets(State<2> &, const MeshData<2> &, const double, const double);
  template void
  close_air_pockets(State<3> &, const MeshData<3> &, const double, const double);
} // namespace treacle
