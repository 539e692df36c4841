// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/liquid_domain.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    template <int dim>
    std::vector<double>
    solid_distances(const Mesh<dim> &mesh, const Scene<dim> &scene, const double time)
    {
      std::vector<double> psi;
      psi.reserve(mesh.node_position.size());
      for (const Point<dim> &x : mesh.node_position)
        psi.push_back(scene.solid_distance(x, time));
      // a wall along nodes is one, whatever rounding says
      for (double &distance : psi)
        if (std::abs(distance) < 1e-10 * mesh.finest_size())
          distance = 0;
      return psi;
    }

    template <int dim>
    VertexValues<dim>
    cell_values(const Mesh<dim> &mesh, const LocalIndex cell, const std::vector<double> &values)
    {
      VertexValues<dim> result;
      for (unsigned int i = 0; i <= dim; ++i)
        result[i] = values[mesh.cell_nodes[cell][i]];
      return result;
    }
  } // namespace

  template <int dim>
  double
  liquid_volume(const Mesh<dim>  &mesh,
                const Vector     &phi,
                const Scene<dim> &scene,
                const double      time)
  {
    const std::vector<double> psi    = solid_distances(mesh, scene, time);
    double                    volume = 0;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      volume += liquid_moments<dim>(mesh.cell_vertices(c),
                                    mesh.values(c, phi),
                                    cell_values(mesh, c, psi))
                  .volume;
    return Utilities::MPI::sum(volume, mesh.communicator());
  }

  template <int dim>
  LiquidDomain<dim>::LiquidDomain(const State<dim> &state,
                                  const Scene<dim> &scene,
                                  const double      minimum_theta,
                                  const Hold        hold)
    : mesh(*state.mesh)
    , scene(scene)
    , minimum_theta(minimum_theta)
  {
    scene.check_solids(state.time);
    solid_distance = solid_distances(mesh, scene, state.time);
    if (hold == Hold::walls && scene.has_solids())
      cut_cells = CutCells<dim>(mesh, scene, solid_distance, state.time);
    find_emitters(state.time);
    measure_cells(state);
    measure_faces(state);
    measure_nodes(state);
  }

  template <int dim>
  void
  LiquidDomain<dim>::find_emitters(const double time)
  {
    held_distance = solid_distance;
    is_emitter_node.assign(solid_distance.size(), 0);
    if (scene.emitters().empty())
      return;
    for (LocalIndex node = 0; node < held_distance.size(); ++node)
      {
        const double distance = scene.emitter_distance(mesh.node_position[node], time);
        is_emitter_node[node] = distance <= 0 && solid_distance[node] > 0;
        held_distance[node]   = std::min(held_distance[node], distance);
      }
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
        const VertexValues<dim> phi = mesh.values(c, state.phi);
        const VertexValues<dim> psi = cell_values(mesh, c, solid_distance);
        const Simplex<dim>  x       = mesh.cell_vertices(c);
        const Moments<dim>  moments = liquid_moments<dim>(x, phi, psi);
        const VertexValues<dim> held = cell_values(mesh, c, held_distance);
        const bool is_open = *std::max_element(held.begin(), held.end()) > 0;
        dual_distance[c]            = phi[0];
        for (unsigned int i = 0; i <= dim; ++i)
          dual_distance[c] += phi[i] * (mesh.cell_gradients[c][i] * (mesh.cell_dual[c] - x[0]));
        liquid_volume[c]    = moments.volume;
        is_pressure_cell[c] = is_open && dual_distance[c] < 0;
        is_active_cell[c]   = is_pressure_cell[c] || moments.volume > 0;
        if (!is_active_cell[c])
          continue;
        liquid_centre[c] = moments.volume > 0 ? Point<dim>(moments.first / moments.volume) :
                                                mesh.cell_dual[c];
        if (state.material)
          {
            // P1: the value at the centroid is the mean over the liquid part
            VertexValues<dim> lambda;
            for (unsigned int i = 0; i <= dim; ++i)
              lambda[i] = (i == 0) + mesh.cell_gradients[c][i] * (liquid_centre[c] - x[0]);
            const auto mean = [&](const Vector &field) {
              const VertexValues<dim> values = mesh.values(c, field);
              const double            value =
                std::inner_product(lambda.begin(), lambda.end(), values.begin(), 0.);
              // the dual centre, which stands in for it, may lie outside of its cell
              const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
              return std::min(std::max(value, *lower), *upper);
            };
            viscosity[c] = mean(state.material->viscosity);
            density[c]   = mean(state.material->density);
            if (!(density[c] > 0))
              keep_error(error, [&] {
                value_error("The density that the liquid carries",
                            density[c],
                            "positive",
                            liquid_centre[c],
                            state.time);
              });
          }
        else
          keep_error(error, [&] {
            viscosity[c] = scene.viscosity(liquid_centre[c], state.time);
            density[c]   = scene.density(liquid_centre[c], state.time);
          });
      }
    throw_first(mesh.communicator(), error);
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_openings(const LocalIndex f, const double time)
  {
    std::array<Point<dim>, dim> x;
    VertexValues<dim - 1>       open, held;
    for (unsigned int i = 0; i < dim; ++i)
      {
        x[i]    = mesh.node_position[mesh.face_nodes[f][i]];
        held[i] = held_distance[mesh.face_nodes[f][i]];
        open[i] = -held[i];
      }
    open_fraction[f] = negative_fraction<dim - 1>(open);
    // through slits the least error of what the others carry would shoot
    if (open_fraction[f] < 1e-4)
      open_fraction[f] = 0;
    if (open_fraction[f] == 1 && mesh.face_side[f] == Mesh<dim>::no_side)
      return;
    // at the centroid the flux of a rigid motion is exact, and what the held parts of
    // a cell's faces carry balances but for the area between them
    const Point<dim> centre = negative_centroid<dim>(x, held);
    const bool       in_emitter =
      scene.emitter_distance(centre, time) < scene.solid_distance(centre, time);
    if (mesh.face_side[f] == Mesh<dim>::no_side)
      solid_velocity[f] = (in_emitter ? scene.emitter_velocity(centre, time) :
                                        scene.solid_velocity(centre, time)) *
                          mesh.face_normal[f];
    else
      {
        // a wall at rest, but where an emitter pours through it
        if (in_emitter)
          solid_velocity[f] = negative_fraction<dim - 1>(held) *
                              (scene.emitter_velocity(centre, time) * mesh.face_normal[f]);
        open_fraction[f] = 0;
      }
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_faces(const State<dim> &state)
  {
    const unsigned int n = mesh.face_cells.size();
    open_fraction.assign(n, 0);
    theta.assign(n, 0);
    solid_velocity.assign(n, 0);

    Vector      mass = mesh.zeros(mesh.faces), part = mesh.zeros(mesh.faces);
    unsigned int n_clamped = 0;
    std::string  error;
    for (LocalIndex f = 0; f < n; ++f)
      {
        keep_error(error, [&] { measure_openings(f, state.time); });
        if (f >= mesh.n_owned_faces() || open_fraction[f] == 0)
          continue;

        const LocalIndex i = mesh.face_cells[f][0], j = mesh.face_cells[f][1];
        if (!is_active_cell[i] && !is_active_cell[j])
          continue;
        double &t = part.local_element(f);
        t         = minimum_theta;
        if (is_pressure_cell[i] && is_pressure_cell[j])
          t = 1;
        else if (is_pressure_cell[i] || is_pressure_cell[j])
          {
            const double a      = dual_distance[is_pressure_cell[i] ? i : j];
            const double b      = std::max(0., dual_distance[is_pressure_cell[i] ? j : i]);
            const double actual = a / (a - b);
            t                   = std::max(actual, minimum_theta);
            n_clamped += actual < minimum_theta;
          }
        const double rho = (is_active_cell[i] ? density[i] : density[j]) / 2 +
                           (is_active_cell[j] ? density[j] : density[i]) / 2;
        mass.local_element(f) =
          rho * open_fraction[f] * mesh.face_area[f] * t * mesh.face_dual_length[f];
      }
    throw_first(mesh.communicator(), error);
    n_clamped_faces = Utilities::MPI::sum(n_clamped, mesh.communicator());
    mass.update_ghost_values();
    part.update_ghost_values();
    face_mass.resize(n);
    for (LocalIndex f = 0; f < n; ++f)
      {
        face_mass[f] = mass.local_element(f);
        theta[f]     = part.local_element(f);
      }
  }

  template <int dim>
  void
  LiquidDomain<dim>::measure_nodes(const State<dim> &state)
  {
    const unsigned int n = mesh.node_position.size();
    constrained.assign(n, 0);
    prescribed.assign(n, Tensor<1, dim>());
    node_mass.assign(n, 0);

    Vector active = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        if (const LocalIndex c = mesh.node_cells[k]; is_active_cell[c])
          {
            active.local_element(node) = 1;
            node_mass[node] += density[c] * liquid_volume[c] / (dim + 1);
          }
    active.update_ghost_values();
    is_active_node.resize(n);
    constexpr unsigned char all = (1u << dim) - 1;
    std::string             error;
    for (LocalIndex node = 0; node < n; ++node)
      {
        is_active_node[node] = active.local_element(node) > 0;
        for (unsigned int wall = 0; wall < Walls<dim>::n; ++wall)
          if (mesh.node_sides[node] >> wall & 1)
            constrained[node] |= scene.no_slip(wall) ? all : 1u << Walls<dim>::axis(wall);
        if (solid_distance[node] <= 0)
          {
            prescribed[node]  = scene.solid_velocity(mesh.node_position[node], state.time);
            constrained[node] = all;
          }
        else if (is_emitter_node[node])
          {
            keep_error(error, [&] {
              prescribed[node] = scene.emitter_velocity(mesh.node_position[node], state.time);
            });
            constrained[node] = all;
          }
      }
    throw_first(mesh.communicator(), error);
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

  template double
  liquid_volume(const Mesh<2> &, const Vector &, const Scene<2> &, const double);
  template double
  liquid_volume(const Mesh<3> &, const Vector &, const Scene<3> &, const double);
  template class LiquidDomain<2>;
  template class LiquidDomain<3>;
} // namespace treacle
