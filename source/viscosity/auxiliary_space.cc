// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/viscosity/auxiliary_space.h>

#include <deal.II/lac/solver_minres.h>

#include <sstream>

namespace treacle
{
  namespace
  {
    // Chebyshev polynomial for the eigenvalues of m^-1 W in [1/range, 1]; 1 is a bound,
    // for (n·mean(v_i))^2 <= mean (n·v_i)^2. Measured: doc/method.md
    constexpr unsigned int degree = 16;
    constexpr double       range  = 150;
  } // namespace

  template <int dim>
  AuxiliarySpace<dim>::AuxiliarySpace(
    const FaceCoupled<dim>                    &face_coupled,
    const typename NodeSystem<dim>::Stiffness &stiffness,
    const LinearSolver::Parameters            &parameters)
    : face_coupled(face_coupled)
    , system(face_coupled.system)
    , prm(parameters)
    , n(dim * face_coupled.H.nodes().size())
    , fit(system.assemble(NodeSystem<dim>::Mass::faces, {}))
    , a(fit.shift)
    , b(fit.shift)
    , c(fit.shift)
    , d(fit.shift)
    , faces(system.domain.mesh.zeros(system.domain.mesh.faces))
  {
    set_node_mass();
    LinearSolver::Parameters amg = prm;
    amg.preconditioner           = LinearSolver::Preconditioner::amg;
    multigrid                    = std::make_unique<const LinearSolver>(
      amg, "Viscosity", stiff, [this, stiffness] { return system.stress_free_motions(stiffness); });
  }

  namespace
  {
    /// dim times the blocks of W on the diagonal, for owned nodes.
    template <int dim>
    std::vector<Tensor<2, dim>>
    mass_blocks(const LiquidDomain<dim> &domain)
    {
      const Mesh<dim>            &mesh = domain.mesh;
      std::vector<Tensor<2, dim>> block(mesh.node_position.size());
      // faces of ghosts too: all that touch an owned node are known
      for (LocalIndex f = 0; f < mesh.face_nodes.size(); ++f)
        if (domain.is_liquid_face(f))
          for (const LocalIndex node : mesh.face_nodes[f])
            block[node] += domain.face_mass[f] / dim *
                           outer_product(mesh.face_normal[f], mesh.face_normal[f]);
      return block;
    }
  } // namespace

  template <int dim>
  void
  AuxiliarySpace<dim>::set_node_mass()
  {
    const LiquidDomain<dim>          &domain = system.domain;
    const auto                       &nodes  = face_coupled.H.nodes();
    const std::vector<Tensor<2, dim>> block  = mass_blocks(domain);
    stiff.copy_from(*face_coupled.stiffness().matrix);
    m.resize(nodes.size());
    inverse_m.resize(nodes.size());
    const GlobalIndex first =
      n > 0 ? fit.matrix->locally_owned_range_indices().nth_index_in_set(0) : 0;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        m[i] = block[nodes[i]];
        // few faces may leave a direction without mass, none all of them: then any scale will do
        const double scale = domain.node_mass[nodes[i]] + trace(m[i]);
        const double floor = scale > 0 ? 1e-2 * scale : 1;
        for (unsigned int k = 0; k < dim; ++k)
          {
            const bool free =
              (domain.constrained[nodes[i]] >> k & 1) == 0 && m[i][k][k] > 0;
            for (unsigned int l = 0; l < dim; ++l)
              if (!free && l != k)
                m[i][k][l] = m[i][l][k] = 0;
            m[i][k][k] += floor;
            const GlobalIndex row = first + dim * i + k;
            if (!free)
              fit.matrix->set(row, row, m[i][k][k]);
            stiff.add(row, row, m[i][k][k]);
          }
        inverse_m[i] = invert(m[i]);
      }
    fit.matrix->compress(VectorOperation::insert);
    stiff.compress(VectorOperation::add);
  }

  namespace
  {
    /// y = the blocks times x.
    template <int dim>
    void
    multiply(const std::vector<Tensor<2, dim>> &blocks, Vector &y, const Vector &x)
    {
      for (unsigned int i = 0; i < blocks.size(); ++i)
        {
          Tensor<1, dim> value;
          for (unsigned int k = 0; k < dim; ++k)
            value[k] = x.local_element(dim * i + k);
          value = blocks[i] * value;
          for (unsigned int k = 0; k < dim; ++k)
            y.local_element(dim * i + k) = value[k];
        }
    }
  } // namespace

  template <int dim>
  Vector
  AuxiliarySpace<dim>::zero() const
  {
    const IndexSet rows = fit.matrix->locally_owned_range_indices();
    IndexSet       pairs(2 * rows.size());
    if (n > 0)
      pairs.add_range(2 * rows.nth_index_in_set(0), 2 * rows.nth_index_in_set(0) + 2 * n);
    return Vector(pairs, system.domain.mesh.communicator());
  }

  template <int dim>
  void
  AuxiliarySpace<dim>::apply_G(Vector &v, const Vector &f) const
  {
    face_coupled.H.Tvmult(faces, f);
    faces.scale(face_coupled.inverse_mass());
    faces.update_ghost_values();
    face_coupled.H.vmult(v, faces);
  }

  template <int dim>
  void
  AuxiliarySpace<dim>::vmult(Vector &y, const Vector &x) const
  {
    std::copy_n(x.begin(), n, a.begin());
    std::copy_n(x.begin() + n, n, b.begin());
    face_coupled.stiffness().matrix->vmult(c, a);
    c -= b;
    apply_G(d, b);
    d += a;
    d *= -1;
    std::copy_n(c.begin(), n, y.begin());
    std::copy_n(d.begin(), n, y.begin() + n);
  }

  template <int dim>
  void
  AuxiliarySpace<dim>::invert_fit(Vector &z, const Vector &r) const
  {
    const double centre = (1 + 1 / range) / 2, radius = (1 - 1 / range) / 2;
    double       rho = radius / centre;
    z.equ(1 / centre, r);
    c = z;
    for (unsigned int k = 1; k < degree; ++k)
      {
        fit.matrix->vmult(d, z);
        multiply(inverse_m, d, d);
        d.sadd(-1, 1, r);
        const double next = 1 / (2 * centre / radius - rho);
        c.sadd(next * rho, 2 * next / radius, d);
        z += c;
        rho = next;
      }
    multiply(m, z, z);
  }

  template <int dim>
  void
  AuxiliarySpace<dim>::precondition(Vector &z, const Vector &r) const
  {
    std::copy_n(r.begin(), n, a.begin());
    multigrid->precondition(b, a);
    std::copy_n(b.begin(), n, z.begin());
    std::copy_n(r.begin() + n, n, a.begin());
    invert_fit(b, a);
    std::copy_n(b.begin(), n, z.begin() + n);
  }

  template <int dim>
  double
  AuxiliarySpace<dim>::residual(const Vector &x, const Vector &v_old) const
  {
    const auto &K = face_coupled.stiffness();
    std::copy_n(x.begin() + n, n, c.begin());
    apply_G(a, c);
    a.sadd(-1, 1, v_old);
    K.matrix->vmult(b, a);
    b.sadd(-1, 1, K.shift);
    b += c;
    face_coupled.H.Tvmult(faces, b);
    return faces.l2_norm();
  }

  template <int dim>
  unsigned int
  AuxiliarySpace<dim>::minimize(Vector       &x,
                                const Vector &rhs,
                                const Vector &v_old,
                                const double  norm) const
  {
    double     last    = 0;
    const auto is_done = [&](const unsigned int step, const double, const Vector &x) {
      // the residual costs as much as half an iteration
      if (step % 4 != 0 && step < prm.maximum_iterations)
        return SolverControl::iterate;
      last = residual(x, v_old);
      return last <= prm.relative_tolerance * norm ? SolverControl::success :
             step >= prm.maximum_iterations        ? SolverControl::failure :
                                                     SolverControl::iterate;
    };
    SolverControl control(prm.maximum_iterations, std::numeric_limits<double>::max());
    SolverMinRes<Vector> solver(control);
    solver.connect(is_done);
    try
      {
        solver.solve(Multiplies<Vector>{[&](Vector &y, const Vector &x) { vmult(y, x); }},
                     x,
                     rhs,
                     Multiplies<Vector>{[&](Vector &z, const Vector &r) { precondition(z, r); }});
      }
    catch (const SolverControl::NoConvergence &failure)
      {
        std::ostringstream message;
        message
          << "Linear solvers/Viscosity: MINRES for the mapping face coupled reached a "
             "relative residual of "
          << last / norm << " in " << control.last_step() << " iterations instead of "
          << prm.relative_tolerance
          << ". Raise Maximum iterations, Relative tolerance or Pressure/Minimum theta, or "
             "set Preconditioner = jacobi.";
        throw UserError(message.str());
      }
    return control.last_step();
  }

  template <int dim>
  unsigned int
  AuxiliarySpace<dim>::solve(Vector &u) const
  {
    const double norm = face_coupled.right_hand_side(u).l2_norm();
    require_finite(norm, "Viscosity");
    if (norm == 0)
      return 0;
    Vector x = zero(), rhs = zero(), v_old(fit.shift);
    u.update_ghost_values();
    face_coupled.H.vmult(v_old, u);
    u.zero_out_ghost_values();
    std::copy_n(v_old.begin(), n, x.begin());
    std::copy_n(face_coupled.stiffness().shift.begin(), n, rhs.begin());
    std::transform(v_old.begin(),
                   v_old.begin() + n,
                   rhs.begin() + n,
                   std::negate<double>());
    const unsigned int iterations = minimize(x, rhs, v_old, norm);

    std::copy_n(x.begin() + n, n, a.begin());
    face_coupled.H.Tvmult(faces, a);
    faces.scale(face_coupled.inverse_mass());
    u -= faces;
    return iterations;
  }

  template class AuxiliarySpace<2>;
  template class AuxiliarySpace<3>;
} // namespace treacle
