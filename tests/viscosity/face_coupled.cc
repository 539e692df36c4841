// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The face-coupled operator on a pool with a solid, one wall without slip and others with:
// H and its transpose, symmetry, positive definiteness; a common motion of liquid, walls
// and solid, prescribed values not zero, that the viscous step must leave alone. The auxiliary
// space: its system and preconditioner, and the same solution as with the diagonal.

#include "../tests.h"
#include "../body.h"

#include <treacle/viscosity/auxiliary_space.h>

namespace tests::viscosity_face_coupled
{
namespace
{
  /// Any numbers that do not depend on the partition.
  template <int dim>
  double
  noise(const Point<dim> &x, const double frequency)
  {
    double sum = 0;
    for (unsigned int d = 0; d < dim; ++d)
      sum += std::sin(frequency * (d + 1) * x[d] + d);
    return sum;
  }

  template <int dim>
  treacle::Vector
  face_noise(const LiquidDomain<dim> &domain, const double frequency)
  {
    treacle::Vector u = domain.mesh.zeros(domain.mesh.faces);
    for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        u.local_element(f) = noise(domain.mesh.face_centre(f), frequency);
    return u;
  }

  void
  report(const std::string &what, const double error)
  {
    out() << "  " << what << ": " << (error < 1e-12 ? "below 1e-12" : std::to_string(error))
          << std::endl;
  }

  template <int dim>
  void
  check_operator(Body<dim> &body, const std::string &stress_model)
  {
    const LiquidDomain<dim>            &domain = body.domain;
    typename NodeSystem<dim>::Stiffness stiffness;
    (stress_model == "full" ? stiffness.strain : stiffness.gradient) = domain.liquid_volume;
    const FaceCoupled<dim> A(body.fit.system, stiffness);

    const treacle::Vector p = face_noise(domain, 61), q = face_noise(domain, 83);
    treacle::Vector       Ap(p), Aq(q), Hp(body.fit.system.unknowns(body.state.v)), x(Hp), Htx(p);
    for (unsigned int i = 0; i < A.H.nodes().size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        x.local_element(dim * i + d) = noise(domain.mesh.node_position[A.H.nodes()[i]], 70 + d);
    A.vmult(Ap, p);
    A.vmult(Aq, q);
    p.update_ghost_values();
    A.H.vmult(Hp, p);
    A.H.Tvmult(Htx, x);
    p.zero_out_ghost_values();
    report("x·Hp - p·H'x, relative", std::abs(x * Hp - p * Htx) / (x.l2_norm() * Hp.l2_norm()));
    report("q·Ap - p·Aq, relative", std::abs(q * Ap - p * Aq) / (q.l2_norm() * Ap.l2_norm()));
    out() << "  p·Ap positive: " << (p * Ap > 0 && q * Aq > 0) << std::endl;
  }

  template <int dim>
  void
  check_auxiliary_space(Body<dim> &body, const std::string &stress_model)
  {
    const LiquidDomain<dim>            &domain = body.domain;
    typename NodeSystem<dim>::Stiffness stiffness;
    auto &weight = stress_model == "full" ? stiffness.strain : stiffness.gradient;
    for (LocalIndex c = 0; c < domain.liquid_volume.size(); ++c)
      weight.push_back(30 * domain.liquid_volume[c]);
    const FaceCoupled<dim>         A(body.fit.system, stiffness);
    const LinearSolver::Parameters prm{LinearSolver::Preconditioner::amg, 1e-8, 1000};
    const AuxiliarySpace<dim>      space(A, stiffness, prm);

    treacle::Vector    p = space.zero(), q(p), Bp(p), Bq(p);
    const unsigned int n = p.locally_owned_size() / 2;
    for (unsigned int i = 0; i < 2 * n; ++i)
      {
        const Point<dim> &x  = domain.mesh.node_position[A.H.nodes()[i % n / dim]];
        p.local_element(i) = noise(x, 61 + i / n + i % dim);
        q.local_element(i) = noise(x, 83 + i / n + i % dim);
      }
    const auto difference = [&] { return std::abs(q * Bp - p * Bq) / (q.l2_norm() * Bp.l2_norm()); };
    space.vmult(Bp, p);
    space.vmult(Bq, q);
    report("system, q·Cp - p·Cq, relative", difference());
    space.precondition(Bp, p);
    space.precondition(Bq, q);
    report("preconditioner, q·Bp - p·Bq, relative", difference());
    out() << "  p·Bp positive: " << (p * Bp > 0 && q * Bq > 0) << std::endl;

    treacle::Vector       u = face_noise(domain, 7), w(u);
    const treacle::Vector d = A.inverse_diagonal();
    const LinearSolver    jacobi(
      prm,
      "Viscosity",
      [&](treacle::Vector &y, const treacle::Vector &x) { A.vmult(y, x); },
      [&](treacle::Vector &z, const treacle::Vector &r) {
        z = r;
        z.scale(d);
      });
    jacobi.solve(w, A.right_hand_side(w));
    space.solve(u);
    w -= u;
    out() << "  both solutions agree to 1e-5: " << (w.l2_norm() < 1e-5 * u.l2_norm()) << std::endl;
  }

  template <int dim>
  void
  check_common_motion(Body<dim> &body)
  {
    Tensor<1, dim> velocity;
    for (unsigned int d = 0; d < dim; ++d)
      velocity[d] = 1. + d;
    LiquidDomain<dim> &domain = body.domain;
    std::fill(domain.prescribed.begin(), domain.prescribed.end(), velocity);
    body.set_velocity([&](const Point<dim> &) { return velocity; });
    Viscosity<dim>(body.prm.dynamics.viscosity).advance(body.state, body.fit, 0.1);

    double           error = 0;
    const Mesh<dim> &mesh  = domain.mesh;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        error = std::max(error,
                         std::abs(body.state.u.local_element(f) - velocity * mesh.face_normal[f]));
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (domain.is_active_node[node])
        error = std::max(error, (body.state.v.value(node) - velocity).norm());
    error = Utilities::MPI::max(error, mesh.communicator());
    out() << "  common motion, largest change: " << (error < 1e-8 ? "below 1e-8" : std::to_string(error))
          << std::endl;
  }

  template <int dim>
  void
  check(const MPI_Comm &comm, const std::string &stress_model)
  {
    Body<dim> body(comm,
                   graded_mesh(4) +
                     "subsection Domain\nset Wall condition = default: free slip; left: no slip\n"
                     "end\n"
                     "subsection Liquid 1\nset Shape = half space\nset Centre = " +
                     (dim == 2 ? "0.5, 0.02" : "0.5, 0.5, 0.02") +
                     "\nend\nsubsection Solid 1\nset Radius = 0.13\nset Centre = " +
                     (dim == 2 ? "0.5, 0\nset Velocity = 1; 2" : "0.5, 0.5, 0\nset Velocity = 1; 2; 3") +
                     "\nend\nsubsection Pressure\nset Minimum theta = 0.01\nend\nsubsection Viscosity\nset Mapping = face coupled\nset Stress model = " +
                     stress_model + "\nend\n" + tolerance("1e-13"),
                   1);
    out() << dim << "D, " << stress_model << std::endl;
    check_operator(body, stress_model);
    check_auxiliary_space(body, stress_model);
    check_common_motion(body);
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    for (const char *stress_model : {"full", "laplacian"})
      {
        check<2>(comm, stress_model);
        check<3>(comm, stress_model);
      }
  });
}

const Test test("viscosity/face_coupled", start);
} // namespace tests::viscosity_face_coupled
