// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/base/work.h>
#include <treacle/dynamics/stokes.h>
#include <treacle/fields/face_node.h>
#include <treacle/fields/strain_rate.h>
#include <treacle/solvers/conjugate_residuals.h>

namespace treacle
{
  namespace
  {
    /// Where the residual of the first guess is within so many tolerances, by the diagonal, a few
    /// iterations with the diagonal alone cost less than hierarchies.
    constexpr double       near_enough      = 30;
    constexpr unsigned int most_by_diagonal = 20;
    /// Iterations beyond the tolerance for the sake of the outflow.
    constexpr unsigned int most_further = 8;
    /// Of the right-hand side, below which no residual is asked for.
    constexpr double rounding = 1e-13;

    /// Of the faces, each of which has a @p velocity (face). Collective.
    template <int dim, typename Velocity>
    double
    twice_kinetic_energy(const LiquidDomain<dim> &domain, const Velocity &velocity)
    {
      double here = 0;
      for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
        if (domain.face_mass[f] > 0)
          here += domain.face_mass[f] * std::pow(velocity(f), 2);
      return Utilities::MPI::sum(here, domain.mesh.communicator());
    }
  } // namespace

  template <int dim>
  void
  Stokes<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Linear solvers");
    prm.enter_subsection("Coupled");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Of the solve for velocity and pressure together: norm of the residual, measured by "
                      "the preconditioner as energy, over that of the right-hand side, and of what moves where that is less.",
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
    , schur_complement(pressure, hybrid, step)
    , diagonal_inverse(2)
    , hierarchies{[this](Vector &z, const Vector &r) { nodes_solver.precondition(z, r); },
                  [this](Vector &z, const Vector &r) { schur_complement.invert(z, r); }}
    , diagonals{[this](Vector &z, const Vector &r) { scale(z, r, 0); },
                [this](Vector &z, const Vector &r) { scale(z, r, 1); }}
    , outflow(pressure.rows(), domain.mesh.communicator())
  {
    diagonal_inverse.block(0).reinit(hybrid.stiff.shift, true);
    for (const GlobalIndex row : hybrid.stiff.shift.locally_owned_elements())
      diagonal_inverse.block(0)(row) = 1 / hybrid.stiff.matrix->diag_element(row);
    diagonal_inverse.block(1) = schur_complement.inverse_diagonal();
  }

  template <int dim>
  void
  Stokes<dim>::scale(Vector &z, const Vector &r, const unsigned int block) const
  {
    z = r;
    z.scale(diagonal_inverse.block(block));
  }

  template <int dim>
  void
  Stokes<dim>::vmult(Pair &y, const Pair &x) const
  {
    ++Work::here().products;
    hybrid.stiff.matrix->vmult(y.block(0), x.block(0));
    faces.couple(y.block(0), y.block(1), x.block(0), x.block(1));
  }

  template <int dim>
  double
  Stokes<dim>::measure(Pair &y, Pair &r, const Inverse &inverse) const
  {
    inverse.momentum(y.block(0), r.block(0));
    faces.outflow(outflow, y.block(0));
    r.block(1) -= outflow;
    inverse.schur(y.block(1), r.block(1));
    return r * y;
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
                                hybrid.rest[f] * state.u.local_element(f) +
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
  double
  Stokes<dim>::energy(const Pair &x) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    NodeVector<dim>  v(mesh.nodes);
    system.to_nodes(x.block(0), v);
    double lost = 0;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (const double weight = stiffness.in_cell(c); weight > 0)
        lost += 2 * weight * squared_strain_rate(domain, c, v);
    const double leaf_a_step = mesh.finest_size() / step;
    return std::max(twice_kinetic_energy(domain, [&](const LocalIndex) { return leaf_a_step; }),
                    twice_kinetic_energy(domain, [&](const LocalIndex f) { return face_velocity(mesh, v, f); })) +
           Utilities::MPI::sum(lost, mesh.communicator());
  }

  template <int dim>
  double
  Stokes<dim>::outflow_left(const Pair &r, const Pair &y) const
  {
    faces.outflow(outflow, y.block(0));
    outflow += r.block(1);
    return outflow.l2_norm();
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::improve(Pair              &x,
                       const Pair        &b,
                       const Inverse     &inverse,
                       const double       squared_norm,
                       const unsigned int most) const
  {
    // what is prescribed may be all of b, as where a stiff body moves with an emitter, or weight that pressure bears, and little of it motion: then on,
    // as far as digits go, until the residual is as small beside the energy of what moves
    const double tolerated = std::pow(prm.relative_tolerance, 2);
    unsigned int n = 0, n_beside_b = 0;
    const auto   is_within = [&](const double square) {
      ++n;
      if (!(square <= tolerated * squared_norm))
        return false;
      n_beside_b = n_beside_b == 0 ? n : n_beside_b;
      return square <= rounding * rounding * squared_norm || square <= tolerated * energy(x) ||
             (&inverse == &hierarchies && n > 2 * n_beside_b + most_further);
    };
    // then on, while it helps, until the projection has nothing to correct: it would need a hierarchy
    bool         was_within = false; // the residual only falls
    unsigned int further    = 0;
    double       last       = std::numeric_limits<double>::max();
    const auto   is_done    = [&](const Pair &r, const Pair &y) {
      was_within = was_within || is_within(r * y);
      if (!was_within)
        return false;
      const double now   = outflow_left(r, y);
      const bool   helps = now > tolerated_outflow && now < 0.8 * last && tolerated_outflow > 0;
      last               = now;
      return !helps || further++ == most_further;
    };
    const auto iterations =
      ConjugateResiduals<Pair>([this](Pair &y, const Pair &p) { vmult(y, p); },
                               [&](Pair &y, Pair &r) { measure(y, r, inverse); },
                               [](Pair &y) { y.block(1) *= -1; })
        .solve(x, b, is_done, most);
    return !iterations && further > 0 ? most : iterations;
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::solve_by_diagonal(Pair &x, const Pair &b) const
  {
    Pair         r(b), y(b);
    const double squared_norm = measure(y, r, diagonals);
    vmult(r, x);
    r.sadd(-1, 1, b);
    if (!(measure(y, r, diagonals) < squared_norm * std::pow(near_enough * prm.relative_tolerance, 2)))
      return {};
    Pair       attempt    = x;
    const auto iterations = improve(attempt, b, diagonals, squared_norm, most_by_diagonal);
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
    Pair         r(b), y(b);
    const double squared_norm = measure(y, r, hierarchies);
    if (b.l2_norm() > 0 && !(squared_norm > 0)) // the preconditioner is of no use
      return {};
    if (squared_norm == 0)
      {
        x = 0;
        return 0;
      }
    return improve(x, b, hierarchies, squared_norm, prm.maximum_iterations);
  }

  template <int dim>
  std::optional<unsigned int>
  Stokes<dim>::advance(State<dim> &state, Reactions<dim> &reactions) const
  {
    pressure.set_walls(state.u);
    const Pair b = right_hand_side(state);
    Pair       x = first_guess(state, b);
    Vector     u = domain.mesh.zeros(domain.mesh.faces); // much as it will be
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      u.local_element(f) = face_velocity(domain.mesh, state.v, f);
    u.update_ghost_values();
    tolerated_outflow = 0.5 * pressure.tolerated_outflow(u);
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
