// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/chords.h>
#include <treacle/surface/marker_correction.h>
#include <treacle/surface/marker_distance.h>
#include <treacle/surface/smooth_level_set.h>

namespace treacle
{
  namespace
  {
    /// May a surface cut an edge with these distances at its ends, half of which is @p half (m) long? Elsewhere errors of phi, as
    /// between the sides of a sheet, are no error of its volume.
    bool
    may_be_cut(const double a, const double b, const double half)
    {
      return (a < 0) != (b < 0) || std::max(std::abs(a), std::abs(b)) < half;
    }

    /// The same with the distance in its middle.
    bool
    is_cut(const double a, const double b, const double middle)
    {
      return std::min({a, b, middle}) < 0 && std::max({a, b, middle}) >= 0;
    }

    /// How far from this rank's cells the middles of edges from its nodes are at most (leaves). Collective.
    template <int dim>
    double
    middles_beyond_cells(const Mesh<dim> &mesh)
    {
      if (mesh.is_lattice())
        return 1; // no edge is longer than a leaf of the next larger size
      double longest = 0;
      for (LocalIndex c = mesh.n_owned_cells(); c < mesh.cell_nodes.size(); ++c)
        for (const LocalIndex a : mesh.cell_nodes[c])
          for (const LocalIndex b : mesh.cell_nodes[c])
            longest = std::max(longest, mesh.node_position[a].distance(mesh.node_position[b]));
      return Utilities::MPI::max(longest, mesh.communicator()) / (2 * mesh.finest_size());
    }
  } // namespace

  template <int dim>
  MarkerCorrection<dim>::MarkerCorrection(const State<dim> &state)
    : mesh(*state.mesh)
    , position(positions(state.markers))
    , markers(mesh, state.markers, MarkerSheet<dim>::reach, middles_beyond_cells(mesh))
    , of_node(mesh.n_owned_nodes())
  {}

  template <int dim>
  const typename MarkerCorrection<dim>::AroundNode &
  MarkerCorrection<dim>::around(const LocalIndex node, const double size)
  {
    constexpr double alike = 0.45; // cosine; 0.5 is that of the chamfers of a box at its corners
    AroundNode      &result = of_node[node];
    if (result.begin != invalid)
      return result;
    const Point<dim> &x = mesh.node_position[node];
    result.begin        = near.size();
    markers.append_around(x, size, near);
    result.end = near.size();
    if (const auto about = all(result); about.size() > 0)
      {
        const Marker<dim> &first = nearest<dim>(x, about);
        result.nearest           = &first;
        for (const NearMarker<dim> *m : about)
          {
            const double along = m->marker.normal * first.normal;
            result.is_thin     = result.is_thin || along < alike;
            result.has_sides   = result.has_sides || along < ThinPart::facing_away;
          }
      }
    return result;
  }

  template <int dim>
  void
  MarkerCorrection<dim>::apply(State<dim> &state)
  {
    std::vector<double> values;
    for (const auto &at : SmoothLevelSet<dim>(mesh, state.phi).samples(position, guesses))
      values.push_back(at.smoothness < 0.5 ? std::nan("") : at.value);
    markers.set_values(values);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double &phi = state.phi.local_element(node);
        if (std::abs(phi) > 3 * mesh.surface_size())
          continue;
        const double h = surface_size_at_node(mesh, node);
        if (std::abs(phi) > 3 * h)
          continue;
        if (const auto &about = around(node, h); about.nearest)
          phi = corrected<dim>(mesh.node_position[node], phi, all(about), *about.nearest, h, true).value_or(phi);
      }
    state.phi.update_ghost_values();
  }

  template <int dim>
  std::optional<double>
  MarkerCorrection<dim>::in_middle(const Vector &phi, const LocalIndex node, const LocalIndex other, const double size)
  {
    const double         a = phi.local_element(node), b = phi.local_element(other);
    const Tensor<1, dim> half = 0.5 * (mesh.node_position[other] - mesh.node_position[node]);
    if (!may_be_cut(a, b, half.norm()))
      return {};
    static thread_local std::vector<const NearMarker<dim> *> about;
    about.clear();
    const Point<dim> x = mesh.node_position[node] + half;
    markers.append_around(x, size, about);
    if (about.empty())
      return {};
    const auto distance =
      corrected<dim>(x, 0.5 * (a + b), view<dim>(about), nearest<dim>(x, view<dim>(about)), size, false);
    return distance && is_cut(a, b, *distance) ? distance : std::nullopt;
  }

  template <int dim>
  std::vector<typename MarkerCorrection<dim>::ThinNode>
  MarkerCorrection<dim>::thin_nodes(const State<dim> &state, const MeshData<dim> &data)
  {
    const Vector              &phi            = state.phi;
    const std::vector<double> &solid_distance = data.solid_distance(state.time);
    std::vector<ThinNode>     result;
    std::vector<unsigned int> number(mesh.n_owned_nodes(), invalid); // in the result, of nodes
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        const double distance = std::abs(phi.local_element(node));
        if (distance > ThinPart::deep * mesh.surface_size())
          continue;
        const double h = surface_size_at_node(mesh, node);
        if (distance > ThinPart::deep * h || !around(node, h).is_thin)
          continue;
        // gaps are to close, sheets to stay; into solids the surface goes on as it comes
        const bool may_rise = !around(node, h).has_sides && solid_distance[node] > 2 * h;
        ThinNode   at{node, h, may_rise, 0, {}, 0};
        for (const auto &[other, n_cells] : data.neighbours(node))
          if (other != node)
            {
              at.n_cells += n_cells;
              const bool is_known =
                other < mesh.n_owned_nodes() && number[other] != invalid && result[number[other]].size == h;
              if (const auto middle = is_known ? result[number[other]].middle_to(node) : in_middle(phi, node, other, h))
                at.middles.push_back({other, n_cells, *middle});
            }
        number[node] = result.size();
        result.push_back(std::move(at));
      }
    return result;
  }

  template <int dim>
  void
  MarkerCorrection<dim>::fill_thin_parts(State<dim> &state, const MeshData<dim> &data)
  {
    // the mean over a cell is as much larger than that over the middles of its edges, if phi is quadratic
    constexpr double       in_cell  = 2. * dim / (dim + 2);
    constexpr unsigned int n_rounds = 2;
    const auto             phi      = [&](const LocalIndex node) { return state.phi.local_element(node); };
    std::vector<ThinNode>  thin     = thin_nodes(state, data);
    for (unsigned int round = 0; round < n_rounds; ++round)
      {
        std::vector<double> wanted;
        for (const ThinNode &at : thin)
          {
            double above = 0;
            for (const MiddleOfEdge &middle : at.middles)
              above += middle.n_cells * (0.5 * (phi(at.node) + phi(middle.other)) - middle.distance);
            const double by = at.lowered + in_cell * above / at.n_cells;
            wanted.push_back(at.may_rise ? by : std::max(0., by));
          }
        for (unsigned int k = 0; k < thin.size(); ++k)
          {
            state.phi.local_element(thin[k].node) += thin[k].lowered - wanted[k];
            thin[k].lowered = wanted[k];
          }
        state.phi.update_ghost_values();
      }
  }

  template <int dim>
  void
  MarkerCorrection<dim>::fill_chords(State<dim> &state, const MeshData<dim> &data, const SmoothLevelSet<dim> &level_set)
  {
    constexpr double           deep = 1.0001, tolerance = 0.1; // leaves: the nodes of cells that the surface cuts, and a trifle more
    const std::vector<double>  height = heights_above_chords(data, state.phi, level_set.gradients(), deep);
    const std::vector<double> &solid_distance = data.solid_distance(state.time);
    for (LocalIndex node = 0; node < height.size(); ++node)
      {
        if (height[node] == 0)
          continue;
        const double      h     = surface_size_at_node(mesh, node);
        const AroundNode &about = around(node, h);
        if (!about.nearest || about.is_thin || (height[node] < 0 && solid_distance[node] <= 2 * h))
          continue;
        // at kinks the mean gradient is shorter than 1
        const double smooth = std::clamp(2 - std::abs(level_set.gradients().value(node).norm() - 1) / tolerance, 0., 1.);
        state.phi.local_element(node) -=
          smooth * part_corrected<dim>(mesh.node_position[node], all(about), *about.nearest, h) * height[node];
      }
    state.phi.update_ghost_values();
  }

  template class MarkerCorrection<2>;
  template class MarkerCorrection<3>;
} // namespace treacle
