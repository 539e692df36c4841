// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/base/maximum.h>
#include <treacle/fields/connected_liquid.h>
#include <treacle/pressure/projection.h>

#include <map>

namespace treacle
{
  template <int dim>
  void
  Projection<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Pressure");
    prm.add_parameter("Minimum theta",
                      minimum_theta,
                      "Smallest liquid part of the dual edge of a face that the surface cuts.",
                      Patterns::Double(1e-6, 1));
    prm.leave_subsection();
    solver.add_parameters(prm, "Pressure");
  }

  template <int dim>
  Projection<dim>::Projection(const Parameters &parameters, const LiquidDomain<dim> &domain)
    : prm(parameters)
    , domain(domain)
    , numbering(domain.mesh.cells, domain.is_pressure_cell)
    , owned_cells(numbering.owned)
    , number(numbering.number)
    , rows(numbering.rows)
  {
    find_closed_pockets();
    set_up_solver();
  }

  template <int dim>
  void
  Projection<dim>::find_closed_pockets()
  {
    const Mesh<dim> &mesh  = domain.mesh;
    const Vector     label = label_pieces(domain, numbering);

    // which labels see air?
    std::set<GlobalIndex> closed, seen_open;
    for (const LocalIndex c : owned_cells)
      {
        closed.insert(label.local_element(c));
        for (const LocalIndex f : mesh.cell_faces[c])
          for (const LocalIndex other : mesh.face_cells[f])
            if (other != invalid && domain.is_liquid_face(f) && !domain.is_pressure_cell[other])
              seen_open.insert(label.local_element(c));
      }
    const auto all_open = everywhere(mesh.communicator(), seen_open);
    for (const GlobalIndex l : all_open)
      closed.erase(l);
    const auto all_closed = everywhere(mesh.communicator(), closed);

    std::map<GlobalIndex, unsigned int> index;
    for (const GlobalIndex l : all_closed)
      index.emplace(l, index.size());
    pockets.resize(index.size());
    for (unsigned int i = 0; i < owned_cells.size(); ++i)
      {
        const GlobalIndex l  = label.local_element(owned_cells[i]);
        const auto        it = index.find(l);
        if (it == index.end())
          continue;
        pockets[it->second].rows.push_back(i);
        if (number[owned_cells[i]] == l)
          pinned.push_back(i);
      }
    for (Pocket &pocket : pockets)
      {
        pocket.size = Utilities::MPI::sum<GlobalIndex>(pocket.rows.size(), mesh.communicator());
        if (!domain.scene.emitters().empty())
          check_room(pocket);
      }
  }

  template <int dim>
  void
  Projection<dim>::check_room(const Pocket &pocket) const
  {
    const Mesh<dim>      &mesh = domain.mesh;
    // net, of solids that make room too; through faces of emitters whichever way (m^dim/s)
    std::array<double, 2> poured{};
    for (const unsigned int i : pocket.rows)
      for (const LocalIndex f : mesh.cell_faces[owned_cells[i]])
        {
          const auto  &nodes = mesh.face_nodes[f];
          const double sign  = mesh.face_cells[f][0] == owned_cells[i] ? -1 : 1;
          const double flux  = sign * mesh.face_area[f] * (1 - domain.open_fraction[f]) *
                              domain.solid_velocity[f];
          poured[0] += flux;
          if (std::any_of(nodes.begin(), nodes.end(), [&](const LocalIndex node) {
                return domain.is_emitter_node[node];
              }))
            poured[1] += std::abs(flux);
        }
    Utilities::MPI::sum(ArrayView<const double>(poured.data(), 2),
                        mesh.communicator(),
                        ArrayView<double>(poured.data(), 2));
    // not what a few cells between an emitter and a wall see, nor an emitter that stirs
    require(poured[1] == 0 || poured[0] <= 0.5 * poured[1] || pocket.size < 100 ||
              2 * pocket.size <= rows.size(),
            "Emitter: it pours " + digits(poured[0]) + (dim == 2 ? " m^2/s" : " m^3/s") +
              " into a closed container that is full of liquid; there is no room: leave air above the "
              "liquid, or set an earlier Stop time.");
  }

  template <int dim>
  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  Projection<dim>::assemble(const FaceFunction &mobility, const std::vector<double> &diagonal) const
  {
    const Mesh<dim> &mesh   = domain.mesh;
    auto             matrix = std::make_unique<TrilinosWrappers::SparseMatrix>(
      rows, rows, mesh.communicator(), std::vector<unsigned int>(owned_cells.size(), dim + 2));
    std::vector<GlobalIndex> indices;
    std::vector<double>      values;
    for (unsigned int i = 0; i < owned_cells.size(); ++i)
      {
        const LocalIndex c = owned_cells[i];
        indices.assign(1, number[c]);
        values.assign(1, diagonal[i]);
        for (const LocalIndex f : mesh.cell_faces[c])
          if (domain.is_liquid_face(f))
            {
              const double     flux = domain.open_fraction[f] * mesh.face_area[f];
              const double     k    = flux * flux * mobility(f);
              const LocalIndex other =
                mesh.face_cells[f][0] == c ? mesh.face_cells[f][1] : mesh.face_cells[f][0];
              values[0] += k;
              if (number[other] != numbers::invalid_dof_index)
                {
                  indices.push_back(number[other]);
                  values.push_back(-k);
                }
            }
        if (values[0] == 0) // walled in on all sides
          values[0] = 1;
        matrix->set(number[c], indices.size(), indices.data(), values.data(), false);
      }
    matrix->compress(VectorOperation::insert);
    return matrix;
  }

  template <int dim>
  void
  Projection<dim>::set_up_solver()
  {
    matrix = assemble([this](const LocalIndex f) { return 1 / domain.face_mass[f]; },
                      std::vector<double>(owned_cells.size(), 0.));
    for (const unsigned int i : pinned)
      {
        const GlobalIndex row = number[owned_cells[i]];
        matrix->set(row, row, 2 * matrix->diag_element(row));
      }
    matrix->compress(VectorOperation::insert);
    solver = std::make_unique<LinearSolver>(prm.solver, "Pressure", *matrix);
  }

  template <int dim>
  double
  Projection<dim>::outflow(const LiquidDomain<dim> &domain, const LocalIndex c, const Vector &u)
  {
    double flux = 0;
    for (const LocalIndex f : domain.mesh.cell_faces[c])
      {
        const double sign  = domain.mesh.face_cells[f][0] == c ? 1 : -1;
        const double alpha = domain.open_fraction[f];
        flux += sign * domain.mesh.face_area[f] *
                (alpha * u.local_element(f) + (1 - alpha) * domain.solid_velocity[f]);
      }
    return flux;
  }

  template <int dim>
  void
  Projection<dim>::take_off_mean(Vector &q, const std::vector<double> &weight) const
  {
    for (const Pocket &pocket : pockets)
      {
        std::array<double, 2> sums{}; // of the weighted values, of the weights
        for (const unsigned int i : pocket.rows)
          {
            sums[0] += weight[i] * q.local_element(i);
            sums[1] += weight[i];
          }
        Utilities::MPI::sum(ArrayView<const double>(sums.data(), 2),
                            domain.mesh.communicator(),
                            ArrayView<double>(sums.data(), 2));
        for (const unsigned int i : pocket.rows)
          q.local_element(i) -= sums[0] / sums[1];
      }
  }

  template <int dim>
  void
  Projection<dim>::take_off_mean(Vector &q) const
  {
    std::vector<double> volume;
    for (const LocalIndex c : owned_cells)
      volume.push_back(domain.mesh.cell_volume[c]);
    take_off_mean(q, volume);
  }

  template <int dim>
  void
  Projection<dim>::to_cells(const Vector &x, Vector &q) const
  {
    for (unsigned int i = 0; i < owned_cells.size(); ++i)
      q.local_element(owned_cells[i]) = x.local_element(i);
    q.update_ghost_values();
  }

  template <int dim>
  void
  Projection<dim>::balance(Vector &b) const
  {
    for (const Pocket &pocket : pockets)
      {
        double excess = 0;
        for (const unsigned int i : pocket.rows)
          excess += b.local_element(i);
        excess = Utilities::MPI::sum(excess, domain.mesh.communicator()) / pocket.size;
        for (const unsigned int i : pocket.rows)
          b.local_element(i) -= excess;
      }
  }

  template <int dim>
  void
  Projection<dim>::set_walls(Vector &u) const
  {
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (domain.open_fraction[f] == 0)
        u.local_element(f) = domain.solid_velocity[f];
    u.update_ghost_values();
  }

  template <int dim>
  double
  Projection<dim>::linear_outflow(const LocalIndex c, const Vector &u) const
  {
    double flux = 0;
    for (const LocalIndex f : domain.mesh.cell_faces[c])
      if (domain.is_liquid_face(f))
        flux += (domain.mesh.face_cells[f][0] == c ? 1 : -1) * domain.open_fraction[f] *
                domain.mesh.face_area[f] * u.local_element(f);
    return flux;
  }

  template <int dim>
  unsigned int
  Projection<dim>::advance(State<dim> &state, const double dt, const Pass pass) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    Vector           b(rows, mesh.communicator()), q(rows, mesh.communicator());
    set_walls(state.u);
    for (unsigned int i = 0; i < owned_cells.size(); ++i)
      {
        b.local_element(i) = -outflow(domain, owned_cells[i], state.u);
        if (pass == Pass::first)
          q.local_element(i) = state.pressure.local_element(owned_cells[i]) * dt;
      }
    balance(b);
    // the matrix makes the pressure of the pinned cells 0, and so must the first guess; but
    // which cells these are depends on the partition
    std::vector<double> is_pinned(owned_cells.size(), 0.);
    for (const unsigned int i : pinned)
      is_pinned[i] = 1;
    take_off_mean(q, is_pinned);
    const unsigned int iterations = solver->solve(q, b);
    take_off_mean(q);

    Vector q_cell = mesh.zeros(mesh.cells);
    to_cells(q, q_cell);
    const Vector q_beyond = extended(q_cell);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        state.u.local_element(f) += impulse(f, q_cell, q_beyond);
    state.u.update_ghost_values();
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      state.pressure.local_element(c) =
        (pass == Pass::first ? 0. : state.pressure.local_element(c)) + q_cell.local_element(c) / dt;
    state.pressure.update_ghost_values();
    return iterations;
  }

  template <int dim>
  Vector
  Projection<dim>::extended(const Vector &q) const
  {
    // least squares for the slope q / phi over the pressure cells around a node,
    // then around a cell
    const Mesh<dim> &mesh = domain.mesh;
    Vector           q_phi = mesh.zeros(mesh.nodes), phi_phi = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        if (const LocalIndex c = mesh.node_cells[k]; domain.is_pressure_cell[c])
          {
            const double phi = domain.dual_distance[c];
            q_phi.local_element(node) += q.local_element(c) * phi;
            phi_phi.local_element(node) += phi * phi;
          }
    q_phi.update_ghost_values();
    phi_phi.update_ghost_values();
    // nodes without a pressure cell around them ask their neighbours
    Vector q_phi_far = q_phi, phi_phi_far = phi_phi;
    q_phi_far.zero_out_ghost_values();
    phi_phi_far.zero_out_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (phi_phi.local_element(node) == 0)
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
            {
              q_phi_far.local_element(node) += q_phi.local_element(other);
              phi_phi_far.local_element(node) += phi_phi.local_element(other);
            }
    q_phi_far.update_ghost_values();
    phi_phi_far.update_ghost_values();
    Vector result = q;
    result.zero_out_ghost_values();
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (!domain.is_pressure_cell[c])
        {
          double a = 0, b = 0;
          for (const LocalIndex node : mesh.cell_nodes[c])
            {
              a += q_phi_far.local_element(node);
              b += phi_phi_far.local_element(node);
            }
          result.local_element(c) = b > 0 ? a / b * domain.dual_distance[c] : 0.;
        }
    result.update_ghost_values();
    return result;
  }

  template <int dim>
  double
  Projection<dim>::maximum_divergence(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    double divergence = 0;
    for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
      if (domain.is_pressure_cell[c])
        divergence =
          larger(divergence, std::abs(outflow(domain, c, state.u)) / domain.mesh.cell_volume[c]);
    return largest(domain.mesh.communicator(), divergence);
  }

  template class Projection<2>;
  template class Projection<3>;
} // namespace treacle
