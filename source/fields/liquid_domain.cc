// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    std::vector<double>
    solid_distances(const State<dim> &state, const Scene<dim> &scene)
    {
      std::vector<double> psi;
      psi.reserve(state.mesh->node_position.size());
      for (const Point<dim> &x : state.mesh->node_position)
        psi.push_back(scene.solid_distance(x, state.time));
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
  liquid_volume(const State<dim> &state, const Scene<dim> &scene)
  {
    const Mesh<dim>          &mesh   = *state.mesh;
    const std::vector<double> psi    = solid_distances(state, scene);
    double                    volume = 0;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      volume += liquid_moments<dim>(mesh.cell_vertices(c),
                                    mesh.values(c, state.phi),
                                    cell_values(mesh, c, psi))
                  .volume;
    return Utilities::MPI::sum(volume, mesh.communicator());
  }

  template <int dim>
  LiquidDomain<dim>::LiquidDomain(const State<dim> &state,
                                  const Scene<dim> &scene,
                                  const double      minimum_theta)
    : mesh(*state.mesh)
    , scene(scene)
    , minimum_theta(minimum_theta)
  {
    solid_distance = solid_distances(state, scene);
    measure_cells(state);
    measure_faces(state);
    measure_nodes(state);
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
        const bool          is_open = *std::max_element(psi.begin(), psi.end()) > 0;
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
        keep_error(error, [&] {
          viscosity[c] = scene.viscosity(liquid_centre[c], state.time);
          density[c]   = scene.density(liquid_centre[c], state.time);
        });
      }
    throw_first(mesh.communicator(), error);
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
    for (LocalIndex f = 0; f < n; ++f)
      {
        VertexValues<dim - 1> solid;
        for (unsigned int i = 0; i < dim; ++i)
          solid[i] = -solid_distance[mesh.face_nodes[f][i]];
        open_fraction[f]   = negative_fraction<dim - 1>(solid);
        const Point<dim> x = mesh.face_centre[f];
        if (mesh.face_side[f] != Mesh<dim>::no_side)
          {
            open_fraction[f] = 0; // a wall at rest
            continue;
          }
        if (open_fraction[f] < 1)
          solid_velocity[f] = scene.solid_velocity(x, state.time) * mesh.face_normal[f];
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
      }
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
  liquid_volume(const State<2> &, const Scene<2> &);
  template double
  liquid_volume(const State<3> &, const Scene<3> &);
  template class LiquidDomain<2>;
  template class LiquidDomain<3>;
} // namespace treacle
