// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exchange.h>
#include <treacle/fields/dual_density.h>
#include <treacle/fields/face_opening.h>
#include <treacle/fields/gradients.h>
#include <treacle/fields/held_nodes.h>
#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/meeting_solids.h>
#include <treacle/fields/viscosity_jumps.h>
#include <treacle/scene/bodies.h>

namespace treacle
{
  template <int dim>
  void
  LiquidDomain<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Viscosity");
    add_choice<Hold>(prm,
                     "Solid walls",
                     hold,
                     "Where solids hold the liquid: at their walls, which cut cells, or at the nodes "
                     "inside them, to first order.",
                     {{"cut cells", Hold::walls}, {"nodes", Hold::nodes}});
    prm.leave_subsection();
    prm.enter_subsection("Pressure");
    prm.add_parameter("Minimum theta",
                      minimum_theta,
                      "Smallest liquid part of the dual edge of a face that the surface cuts.",
                      Patterns::Double(1e-9, 1));
    prm.leave_subsection();
  }

  template <int dim>
  LiquidDomain<dim>::LiquidDomain(const Parameters    &parameters,
                                  const State<dim>    &state,
                                  const MeshData<dim> &data,
                                  const bool           emitters_rest)
    : data(data)
    , mesh(data.mesh)
    , scene(data.scene)
    , minimum_theta(parameters.minimum_theta)
    , emitters_rest(emitters_rest)
  {
    scene.check_solids(state.time);
    solid_distance = data.solid_distance(state.time);
    if (parameters.hold == Hold::walls && scene.has_solids())
      cut_cells = CutCells<dim>(mesh, scene, solid_distance, state.time);
    find_emitters(state.time);
    measure_cells(state);
    HeldNodes<dim> held = held_nodes(scene, state, solid_distance, is_emitter_node, is_pressure_cell);
    constrained         = std::move(held.constrained);
    prescribed          = std::move(held.prescribed);
    find_free_cells();
    measure_faces(state);
    find_meeting_solids(state.time);
    measure_nodes();
  }

  template <int dim>
  void
  LiquidDomain<dim>::find_emitters(const double time)
  {
    held_distance = solid_distance;
    is_emitter_node.assign(solid_distance.size(), 0);
    emitter_distance.clear();
    if (scene.emitters().empty() || emitters_rest)
      return;
    emitter_distance.resize(held_distance.size());
    for (LocalIndex node = 0; node < held_distance.size(); ++node)
      {
        const double distance = scene.emitter_distance(mesh.node_position[node], time);
        emitter_distance[node] = distance;
        is_emitter_node[node] = distance <= 0 && solid_distance[node] > 0;
        held_distance[node]   = std::min(held_distance[node], distance);
      }
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_cell(const LocalIndex c, const State<dim> &state)
  {
    const VertexValues<dim> phi     = mesh.values(c, state.phi);
    const Simplex<dim>      x       = mesh.cell_vertices(c);
    const Moments<dim>      moments =
      liquid_moments<dim>(x, phi, mesh.values(c, solid_distance));
    const VertexValues<dim> held    = mesh.values(c, held_distance);
    const bool              is_open = *std::max_element(held.begin(), held.end()) > 0;
    double                  at_dual = phi[0]; // phi at the dual centre
    for (unsigned int i = 0; i <= dim; ++i)
      at_dual += phi[i] * (mesh.cell_gradients[c][i] * (mesh.cell_dual[c] - x[0]));
    dual_distance[c]    = snapped(at_dual, scene.rounding());
    liquid_volume[c]    = moments.volume;
    is_active_cell[c]   = moments.volume > 0;
    is_pressure_cell[c] = is_active_cell[c] && is_open && dual_distance[c] < 0;
    if (is_active_cell[c])
      liquid_centre[c] = moments.first / moments.volume;
  }

  template <int dim>
  void
  LiquidDomain<dim>::find_material(const LocalIndex c, const State<dim> &state)
  {
    if (!state.material)
      {
        viscosity[c] = scene.viscosity(liquid_centre[c], state.time);
        density[c]   = scene.density(liquid_centre[c], state.time);
        return;
      }
    // P1: the value at the centroid is the mean over the liquid part
    const VertexValues<dim> lambda = weights_at(mesh, c, liquid_centre[c]);
    const auto              mean = [&](const Vector &field) {
      const VertexValues<dim> values = mesh.values(c, field);
      const double            value  = interpolate(values, lambda);
      // the centroid of next to nothing may lie outside of its cell
      const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
      return std::min(std::max(value, *lower), *upper);
    };
    viscosity[c] = mean(state.material->viscosity.mean);
    density[c]   = mean(state.material->density.mean);
    if (!(density[c] > 0))
      value_error("The density that the liquid carries",
                  density[c],
                  "positive",
                  liquid_centre[c],
                  state.time);
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_cells(const State<dim> &state)
  {
    const unsigned int n = mesh.cell_nodes.size();
    liquid_volume.assign(n, 0);
    liquid_centre.resize(n);
    dual_distance.resize(n);
    is_pressure_cell.assign(n, 0);
    is_active_cell.assign(n, 0);
    viscosity.assign(n, 0);
    density.assign(n, 0);

    std::string error;
    for (LocalIndex c = 0; c < n; ++c)
      {
        measure_cell(c, state);
        if (is_active_cell[c])
          keep_error(error, [&] { find_material(c, state); });
      }
    throw_first(mesh.communicator(), error);
    viscosity_jumps = soften_jumps(scene, state, solid_distance, cut_cells, liquid_volume, viscosity);
  }

  template <int dim>
  double
  LiquidDomain<dim>::liquid_part_of_dual_edge(const LocalIndex face) const
  {
    const LocalIndex i = mesh.face_cells[face][0], j = mesh.face_cells[face][1];
    if (is_pressure_cell[i] && is_pressure_cell[j])
      return 1;
    if (!is_pressure_cell[i] && !is_pressure_cell[j])
      return is_free_face(face) ? (liquid_fraction(i) + liquid_fraction(j)) / 2 : minimum_theta;
    const LocalIndex inside = is_pressure_cell[i] ? i : j, other = is_pressure_cell[i] ? j : i;
    // a cell of the air may have its dual centre in the liquid, where leaves change: the surface is beyond that
    const double most = is_active_cell[other] ? 1. : std::max(1., mesh.cell_size[inside] / mesh.face_dual_length[face]);
    const double a = dual_distance[inside], b = std::max((1 - 1 / most) * a, dual_distance[other]);
    return a / (a - b);
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_faces(const State<dim> &state)
  {
    const unsigned int n = mesh.face_cells.size();
    open_fraction.assign(n, 0);
    solid_velocity.assign(n, 0);

    Vector       mass = mesh.zeros(mesh.faces), part = mesh.zeros(mesh.faces);
    unsigned int n_clamped = 0;
    std::string  error;
    const FaceOpening<dim> opening(mesh, scene, solid_distance, emitter_distance, state.time);
    for (LocalIndex f = 0; f < n; ++f)
      {
        keep_error(error, [&] { std::tie(open_fraction[f], solid_velocity[f]) = opening(f); });
        if (f >= mesh.n_owned_faces() || open_fraction[f] == 0)
          continue;
        const LocalIndex i = mesh.face_cells[f][0], j = mesh.face_cells[f][1];
        if (!is_active_cell[i] && !is_active_cell[j])
          continue;
        const double actual = liquid_part_of_dual_edge(f);
        double      &t      = part.local_element(f);
        t                   = std::max(actual, minimum_theta);
        n_clamped += actual < minimum_theta;
        keep_error(error, [&] {
          const double rho = is_pressure_cell[i] || is_pressure_cell[j] ? mean_density(scene, state, f, liquid_part(f, t)) :
                                                                          (is_active_cell[i] ? density[i] : density[j]) / 2 +
                                                                            (is_active_cell[j] ? density[j] : density[i]) / 2;
          mass.local_element(f) = rho * open_fraction[f] * mesh.face_area[f] * t * mesh.face_dual_length[f];
        });
      }
    throw_first(mesh.communicator(), error);
    n_clamped_faces = Utilities::MPI::sum(n_clamped, mesh.communicator());
    mass.update_ghost_values();
    part.update_ghost_values();
    face_mass.assign(mass.begin(), mass.begin() + n);
    theta.assign(part.begin(), part.begin() + n);
  }

  template <int dim>
  void
  LiquidDomain<dim>::find_meeting_solids(const double time)
  {
    if (scene.n_solids() < 2 || !scene.has_moving_solids())
      return;
    VertexValues<dim> whole;
    whole.fill(-far_away);
    std::string error;
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      {
        const VertexValues<dim> distance = mesh.values(c, solid_distance);
        const auto [lower, upper]        = std::minmax_element(distance.begin(), distance.end());
        if (!is_active_cell[c] || *lower > 0 || *upper <= 0 ||
            std::any_of(mesh.cell_nodes[c].begin(), mesh.cell_nodes[c].end(), [this](const LocalIndex n) { return is_emitter_node[n]; }))
          continue;
        keep_error(error, [&] {
          if (const auto swept = swept_by_meeting_solids(mesh, scene, c, whole, time))
            closed_excess[c] = *swept - closed_outflow(c);
        });
      }
    throw_first(mesh.communicator(), error);
  }

  template <int dim>
  void
  LiquidDomain<dim>::find_free_cells()
  {
    Vector is_bound = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        is_bound.local_element(node) = constrained[node] != 0;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          if (is_pressure_cell[mesh.node_cells[k]])
            is_bound.local_element(node) = 1;
      }
    is_bound.update_ghost_values();
    is_free_cell.resize(is_active_cell.size());
    for (LocalIndex c = 0; c < is_free_cell.size(); ++c)
      {
        const VertexValues<dim> bound = mesh.values(c, is_bound);
        is_free_cell[c] =
          is_active_cell[c] && *std::max_element(bound.begin(), bound.end()) == 0;
      }
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_nodes()
  {
    constexpr double light = 1e-3; // of the volume of its cells
    Vector           active = mesh.zeros(mesh.nodes);
    is_light_node.assign(mesh.node_position.size(), 0);
    node_mass.assign(mesh.node_position.size(), 0);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double liquid = 0, all = 0;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          if (const LocalIndex c = mesh.node_cells[k]; is_active_cell[c])
            {
              active.local_element(node) = 1;
              node_mass[node] += density[c] * liquid_volume[c] / (dim + 1);
              liquid += liquid_volume[c];
              all += open_volume(c);
            }
        is_light_node[node] = active.local_element(node) > 0 && liquid < light * all;
      }
    active.update_ghost_values();
    is_active_node.resize(node_mass.size());
    for (LocalIndex node = 0; node < node_mass.size(); ++node)
      is_active_node[node] = active.local_element(node) > 0;
  }

  template <int dim>
  double
  LiquidDomain<dim>::closed_outflow(const LocalIndex cell) const
  {
    double flux = excess_of(cell);
    for (const LocalIndex f : mesh.cell_faces[cell])
      flux += (mesh.face_cells[f][0] == cell ? 1 : -1) * mesh.face_area[f] * (1 - open_fraction[f]) * solid_velocity[f];
    return flux;
  }

  template <int dim>
  double
  LiquidDomain<dim>::total_volume() const
  {
    double volume = 0;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      volume += liquid_volume[c];
    return Utilities::MPI::sum(volume, mesh.communicator());
  }

  template <int dim>
  std::shared_ptr<const LiquidDomain<dim>>
  LiquidDomain<dim>::with_walls_at_rest() const
  {
    const auto domain = std::make_shared<LiquidDomain>(*this);
    std::fill(domain->solid_velocity.begin(), domain->solid_velocity.end(), 0.);
    domain->closed_excess.clear();
    std::fill(domain->prescribed.begin(), domain->prescribed.end(), Tensor<1, dim>());
    return domain;
  }

  template class LiquidDomain<2>;
  template class LiquidDomain<3>;
} // namespace treacle
