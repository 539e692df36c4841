// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/maximum.h>
#include <treacle/pressure/pressure_system.h>

namespace treacle
{
  template <int dim>
  PressureSystem<dim>::PressureSystem(const LinearSolver::Parameters &parameters,
                                      const LiquidDomain<dim>        &domain)
    : domain(domain)
    , numbering(domain.mesh.cells, domain.is_pressure_cell)
    , pockets(domain, numbering)
    , matrix(projection_matrix())
    , solver(parameters, "Pressure", *matrix)
  {}

  template <int dim>
  void
  PressureSystem<dim>::set_row(const LocalIndex    c,
                               const FaceFunction &mobility,
                               const double        diagonal,
                               MatrixRow          &row) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    double           sum  = diagonal;
    row.clear();
    for (const LocalIndex f : mesh.cell_faces[c])
      if (domain.is_liquid_face(f))
        {
          const double     flux = domain.open_fraction[f] * mesh.face_area[f];
          const double     k    = flux * flux * mobility(f);
          const LocalIndex other =
            mesh.face_cells[f][0] == c ? mesh.face_cells[f][1] : mesh.face_cells[f][0];
          sum += k;
          if (numbering.column[other] != invalid)
            row.emplace_back(numbering.column[other], -k);
        }
    // 1 where it is walled in on all sides
    row.emplace_back(numbering.column[c], sum == 0 ? 1. : sum);
    std::sort(row.begin(), row.end());
  }

  template <int dim>
  std::unique_ptr<TrilinosWrappers::SparseMatrix>
  PressureSystem<dim>::assemble(const FaceFunction                   &mobility,
                                const std::vector<double>            &diagonal,
                                const TrilinosWrappers::SparseMatrix *alike) const
  {
    MatrixRows all(alike);
    MatrixRow  row;
    for (unsigned int i = 0; i < cells().size(); ++i)
      {
        set_row(cells()[i], mobility, diagonal[i], row);
        all.append(row);
      }
    return all.take(domain.mesh.communicator(), rows(), numbering.ghost_columns);
  }

  template <int dim>
  std::unique_ptr<const TrilinosWrappers::SparseMatrix>
  PressureSystem<dim>::projection_matrix() const
  {
    auto matrix = assemble([this](const LocalIndex f) { return 1 / domain.face_mass[f]; },
                           std::vector<double>(cells().size(), 0.),
                           nullptr);
    for (const unsigned int i : pockets.pinned())
      {
        const GlobalIndex row = numbering.number[cells()[i]];
        matrix->set(row, row, 2 * matrix->diag_element(row));
      }
    matrix->compress(VectorOperation::insert);
    return matrix;
  }

  template <int dim>
  unsigned int
  PressureSystem<dim>::solve(Vector &q, Vector &b, const double scale) const
  {
    pockets.balance(b);
    // the matrix makes the pressure of the pinned cells 0, and so must the first guess; but
    // which cells these are depends on the partition
    pockets.take_off_pinned(q);
    const unsigned int iterations = solver.solve(q, b, scale);
    pockets.take_off_mean(q);
    return iterations;
  }

  template <int dim>
  double
  PressureSystem<dim>::throughflow(const Vector &u) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    double           sum  = 0;
    for (const LocalIndex c : cells())
      {
        double flux = 0;
        for (const LocalIndex f : mesh.cell_faces[c])
          flux += mesh.face_area[f] * domain.open_fraction[f] * std::abs(u.local_element(f));
        sum += flux * flux;
      }
    return std::sqrt(Utilities::MPI::sum(sum, mesh.communicator()));
  }

  template <int dim>
  double
  PressureSystem<dim>::outflow(const LiquidDomain<dim> &domain, const LocalIndex c, const Vector &u)
  {
    double flux = 0;
    for (const LocalIndex f : domain.mesh.cell_faces[c])
      {
        const double sign  = domain.mesh.face_cells[f][0] == c ? 1 : -1;
        const double alpha = domain.open_fraction[f];
        flux += sign * domain.mesh.face_area[f] *
                (alpha * u.local_element(f) + (1 - alpha) * domain.solid_velocity[f]);
      }
    return flux + domain.excess_of(c);
  }

  template <int dim>
  void
  PressureSystem<dim>::set_walls(Vector &u) const
  {
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (domain.open_fraction[f] == 0)
        u.local_element(f) = domain.solid_velocity[f];
    u.update_ghost_values();
  }

  template <int dim>
  void
  PressureSystem<dim>::to_cells(const Vector &x, Vector &q) const
  {
    for (unsigned int i = 0; i < cells().size(); ++i)
      q.local_element(cells()[i]) = x.local_element(i);
    q.update_ghost_values();
  }

  template <int dim>
  void
  PressureSystem<dim>::push(const Vector &q, Vector &u) const
  {
    const Vector q_beyond = extended(q);
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (!domain.is_liquid_face(f))
        continue;
      else if (is_unknown(f))
        u.local_element(f) += force(f, q) / domain.face_mass[f];
      else if (!domain.is_free_face(f)) // that has the mass of its liquid, and nothing takes the force back
        u.local_element(f) += domain.theta[f] * force(f, q_beyond) / domain.face_mass[f];
    u.update_ghost_values();
  }

  namespace
  {
    /// Sums for the slope q / phi by least squares.
    struct Slope
    {
      Vector q_phi, phi_phi;

      explicit Slope(const std::shared_ptr<const Utilities::MPI::Partitioner> &nodes)
        : q_phi(nodes)
        , phi_phi(nodes)
      {}

      void
      update_ghost_values() const
      {
        q_phi.update_ghost_values();
        phi_phi.update_ghost_values();
      }

      bool
      is_known(const LocalIndex node) const
      {
        return phi_phi.local_element(node) != 0;
      }
    };

    /// In leaves: where a dual centre lies less deep, q / phi is the solver's error over nothing.
    constexpr double least_depth = 0.01;

    /// Over the pressure cells around each node.
    template <int dim>
    Slope
    slope_at_nodes(const LiquidDomain<dim> &domain, const Vector &q)
    {
      const Mesh<dim> &mesh = domain.mesh;
      Slope            slope(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          if (const LocalIndex c   = mesh.node_cells[k];
              domain.is_pressure_cell[c] && domain.dual_distance[c] < -least_depth * mesh.cell_size[c])
            {
              const double phi = domain.dual_distance[c];
              slope.q_phi.local_element(node) += q.local_element(c) * phi;
              slope.phi_phi.local_element(node) += phi * phi;
            }
      slope.update_ghost_values();
      return slope;
    }

    /// Nodes without such a cell around them ask their neighbours.
    template <int dim>
    Slope
    continued(const Mesh<dim> &mesh, const Slope &slope)
    {
      Slope result = slope;
      result.q_phi.zero_out_ghost_values();
      result.phi_phi.zero_out_ghost_values();
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (!slope.is_known(node))
          for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
            for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
              {
                result.q_phi.local_element(node) += slope.q_phi.local_element(other);
                result.phi_phi.local_element(node) += slope.phi_phi.local_element(other);
              }
      result.update_ghost_values();
      return result;
    }
  } // namespace

  template <int dim>
  Vector
  PressureSystem<dim>::extended(const Vector &q) const
  {
    const Mesh<dim> &mesh   = domain.mesh;
    const Slope      slope  = continued(mesh, slope_at_nodes(domain, q));
    Vector           result = q;
    result.zero_out_ghost_values();
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (!domain.is_pressure_cell[c])
        {
          double a = 0, b = 0;
          for (const LocalIndex node : mesh.cell_nodes[c])
            {
              a += slope.q_phi.local_element(node);
              b += slope.phi_phi.local_element(node);
            }
          result.local_element(c) = b > 0 ? a / b * domain.dual_distance[c] : 0.;
        }
    result.update_ghost_values();
    return result;
  }

  template <int dim>
  double
  PressureSystem<dim>::maximum_divergence(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    double divergence = 0;
    for (LocalIndex c = 0; c < domain.mesh.n_owned_cells(); ++c)
      if (domain.is_pressure_cell[c])
        divergence =
          larger(divergence, std::abs(outflow(domain, c, state.u)) / domain.mesh.cell_volume[c]);
    return largest(domain.mesh.communicator(), divergence);
  }

  template class PressureSystem<2>;
  template class PressureSystem<3>;
} // namespace treacle
