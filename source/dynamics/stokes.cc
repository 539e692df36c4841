// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/base/work.h>
#include <treacle/dynamics/stokes.h>
#include <treacle/fields/face_node.h>

#include <deal.II/lac/solver_minres.h>

namespace treacle
{
  namespace
  {
    /// Of mu step over rho h^2: less than this is none.
    constexpr double least_viscosity = 1e-12;

    /// Where the residual of the first guess is within so many tolerances, by the diagonal, a few
    /// iterations with the diagonal alone cost less than hierarchies.
    constexpr double       near_enough      = 30;
    constexpr unsigned int most_by_diagonal = 20;
  } // namespace

  template <int dim>
  void
  Stokes<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Linear solvers");
    prm.enter_subsection("Coupled");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Of the solve for velocity and pressure together: norm of the preconditioned "
                      "residual over that of the right-hand side.",
                      Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "A step that needs more is taken by split with first projection.",
                      Patterns::Integer(1));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  template <int dim>
  Stokes<dim>::Stokes(const Parameters                          &parameters,
                        const LinearSolver::Parameters            &viscosity_solver,
                        const NodeSystem<dim>                     &system,
                        const typename NodeSystem<dim>::Stiffness &stiffness,
                        const PressureSystem<dim>                 &pressure,
                        const double                               step)
    : prm(parameters)
    , system(system)
    , domain(system.domain)
    , pressure(pressure)
    , step(step)
    , stiffness(stiffness)
    , hybrid(system, stiffness, step, Hybrid<dim>::Faces::under_pressure)
    , nodes_solver(viscosity_solver,
                   "Viscosity",
                   *hybrid.stiff.matrix,
                   [this] { return this->system.stress_free_motions(this->stiffness); })
    , faces(system, pressure, hybrid)
    , viscous_schur(viscous_schur_complement())
    , diagonal_inverse(2)
    , z_viscous(pressure.rows(), domain.mesh.communicator())
  {
    // over its diagonal most of it has eigenvalues from 0.05 to 2, whatever mesh and viscosity are
    if (pressure.rows().size() > 0)
      viscous_schur_inverse.initialize(*viscous_schur, {8, 2., 50.});
    diagonal_inverse.block(0).reinit(hybrid.stiff.shift, true);
    diagonal_inverse.block(1).reinit(pressure.rows(), domain.mesh.communicator());
    for (const GlobalIndex row : hybrid.stiff.shift.locally_owned_elements())
      diagonal_inverse.block(0)(row) = 1 / hybrid.stiff.matrix->diag_element(row);
    for (const GlobalIndex row : pressure.rows())
      diagonal_inverse.block(1)(row) =
        1 / pressure.projection().diag_element(row) + 1 / viscous_schur->diag_element(row);
  }

  template <int dim>
  std::unique_ptr<const TrilinosWrappers::SparseMatrix>
  Stokes<dim>::viscous_schur_complement() const
  {
    const Mesh<dim>    &mesh = domain.mesh;
    std::vector<double> mass;
    for (const LocalIndex c : pressure.cells())
      {
        double open = 0, all = 0; // squares of areas
        for (const LocalIndex f : mesh.cell_faces[c])
          {
            open += std::pow(domain.open_fraction[f] * mesh.face_area[f], 2);
            all += std::pow(mesh.face_area[f], 2);
          }
        // little goes out of a cell that solids or emitters all but close
        const double volume = std::min(domain.open_volume(c), open / all * mesh.cell_volume[c]);
        const double mu_dt =
          std::max(domain.viscosity[c] * step,
                   least_viscosity * domain.density[c] * std::pow(mesh.cell_size[c], 2));
        mass.push_back(volume / (2 * mu_dt));
      }
    return pressure.assemble(
      [this](const LocalIndex f) { return (1 - hybrid.share[f]) / domain.face_mass[f]; }, mass);
  }

  template <int dim>
  void
  Stokes<dim>::vmult(Pair &y, const Pair &x) const
  {
    ++Work::here().products;
    hybrid.stiff.matrix->vmult(y.block(0), x.block(0));
    faces.apply(y.block(0), y.block(1), x.block(0), x.block(1));
  }

  template <int dim>
  void
  Stokes<dim>::precondition(Pair &z, const Pair &r) const
  {
    nodes_solver.precondition(z.block(0), r.block(0));
    pressure.precondition(z.block(1), r.block(1));
    viscous_schur_inverse.vmult(z_viscous, r.block(1));
    z.block(1) += z_viscous;
  }

  template <int dim>
  typename Stokes<dim>::Pair
  Stokes<dim>::right_hand_side(const State<dim> &state) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    Pair             b(2);
    b.block(0) = hybrid.right_hand_side(state.u, state.v);
    b.block(1).reinit(pressure.rows(), mesh.communicator());
    b.collect_sizes();

    // (1 - s) u* + s P v of the prescribed components alone
    const auto     &nodes = system.nodes();
    NodeVector<dim> v(mesh.nodes);
    Vector          flux = mesh.zeros(mesh.faces);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        v.component[d].local_element(nodes[i]) =
          domain.constrained[nodes[i]] >> d & 1 ? domain.prescribed[nodes[i]][d] : 0.;
    v.update_ghost_values();
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      flux.local_element(f) = domain.is_liquid_face(f) ?
                                (1 - hybrid.share[f]) * state.u.local_element(f) +
                                  hybrid.share[f] * face_velocity(mesh, v, f) :
                                state.u.local_element(f);
    flux.update_ghost_values();
    const auto &cells = pressure.cells();
    for (unsigned int i = 0; i < cells.size(); ++i)
      b.block(1).local_element(i) = pressure.outflow(domain, cells[i], flux);
    pressure.pockets.balance(b.block(1));
    return b;
  }

  template <int dim>
  void
  Stokes<dim>::set_faces(State<dim> &state, const Pair &x, Reactions<dim> &reactions) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    Vector           q    = mesh.zeros(mesh.cells);
    pressure.to_cells(x.block(1), q);
    system.to_nodes(x.block(0), state.v);
    pressure.push(q, state.u);
    // on what is prescribed pressure acts by itself
    hybrid.drag_faces(state, stiffness, &reactions);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      state.pressure.local_element(c) = q.local_element(c) / step;
    state.pressure.update_ghost_values();
  }

  template <int dim>
  typename Stokes<dim>::Pair
  Stokes<dim>::first_guess(const State<dim> &state, const Pair &b) const
  {
    Pair x(b);
    x.block(0)        = system.unknowns(state.v);
    const auto &cells = pressure.cells();
    for (unsigned int i = 0; i < cells.size(); ++i)
      x.block(1).local_element(i) = state.pressure.local_element(cells[i]) * step;
    return x;
  }

  template <int dim>
  void
  Stokes<dim>::scale(Pair &z, const Pair &r) const
  {
    for (unsigned int k = 0; k < 2; ++k)
      {
        z.block(k) = r.block(k);
        z.block(k).scale(diagonal_inverse.block(k));
      }
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::minres(Pair              &x,
                      const Pair        &b,
                      const Operator    &preconditioner,
                      const double       squared_norm,
                      const unsigned int most) const
  {
    SolverControl      control(most, prm.relative_tolerance * std::sqrt(squared_norm));
    SolverMinRes<Pair> solver(control);
    try
      {
        solver.solve(Multiplies<Pair>{[&](Pair &y, const Pair &p) { vmult(y, p); }},
                     x,
                     b,
                     Multiplies<Pair>{preconditioner});
      }
    catch (const SolverControl::NoConvergence &)
      {
        return {};
      }
    return control.last_step();
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::solve_by_diagonal(Pair &x, const Pair &b) const
  {
    Pair r(b), z(b);
    scale(z, b);
    const double squared_norm = b * z;
    vmult(r, x);
    r.sadd(-1, 1, b);
    scale(z, r);
    if (!(r * z < squared_norm * std::pow(near_enough * prm.relative_tolerance, 2)))
      return {};
    Pair       attempt = x;
    const auto iterations =
      minres(attempt, b, [this](Pair &y, const Pair &p) { scale(y, p); }, squared_norm, most_by_diagonal);
    if (iterations)
      x = attempt;
    return iterations;
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::solve(Pair &x, const Pair &b) const
  {
    require_finite(b.l2_norm(), "Coupled");
    if (const auto iterations = solve_by_diagonal(x, b))
      return iterations;
    Pair z(b);
    precondition(z, b);
    const double squared_norm = b * z;
    if (b.l2_norm() > 0 && !(squared_norm > 0)) // the preconditioner is of no use
      return {};
    if (squared_norm == 0)
      {
        x = 0;
        return 0;
      }
    return minres(
      x, b, [this](Pair &y, const Pair &r) { precondition(y, r); }, squared_norm, prm.maximum_iterations);
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::advance(State<dim> &state, Reactions<dim> &reactions) const
  {
    pressure.set_walls(state.u);
    const Pair b          = right_hand_side(state);
    Pair       x          = first_guess(state, b);
    const auto iterations = solve(x, b);
    if (!iterations)
      return {};
    pressure.pockets.take_off_mean(x.block(1));
    set_faces(state, x, reactions);
    return iterations;
  }

  template class Stokes<2>;
  template class Stokes<3>;
} // namespace treacle
