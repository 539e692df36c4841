// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// One viscous step on a free disc (case A2) and a free sphere (A3) of radius 1 from the
// velocity that has the exact solution after it: error of the face velocity, relative to
// the solution, in the norm of M_f and at the worst face. Arguments: dimension, levels, settings.

#include "../tests.h"
#include "../body.h"

#include <iomanip>

namespace tests::viscosity_traction_free
{
namespace
{
  template <int dim>
  struct Case
  {
    Tensor<1, dim> velocity, force; ///< and div tau, for mu = 1
  };

  Case<2>
  exact(const Tensor<1, 2> &r)
  {
    const double x = r[0], y = r[1];
    Case<2>      result;
    result.velocity[0] = 2 * x - 2. / 3 * x * (x * x + 3 * y * y);
    result.velocity[1] = -2 * y + 2. / 3 * y * (3 * x * x + y * y);
    result.force[0]    = -8 * x;
    result.force[1]    = 8 * y;
    return result;
  }

  Case<3>
  exact(const Tensor<1, 3> &r)
  {
    Tensor<1, 3> turn;
    turn[0] = -r[1];
    turn[1] = r[0];
    return {std::pow(1 - r.norm_square(), 2) * turn, (28 * r.norm_square() - 20) * turn};
  }

  template <int dim>
  void
  check(const MPI_Comm &comm, const std::string &mapping, const unsigned int level)
  {
    Body<dim> body(comm,
                   graded_mesh(level) + "subsection Domain\nset Lower corner = " +
                     (dim == 2 ? "-1.5, -1.5" : "-1.5, -1.5, -1.5") + "\nset Upper corner = " +
                     (dim == 2 ? "1.5, 1.5" : "1.5, 1.5, 1.5") +
                     "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 1\nend\n" +
                     "subsection Liquid 1\nset Radius = 1\nset Centre = " +
                     (dim == 2 ? "0.013, -0.027" : "0.013, -0.027, 0.036") +
                     "\nend\n" + with_mapping(mapping) +
                     tolerance("1e-11") + "subsection Linear solvers\nsubsection Viscosity\n" +
                     "set Maximum iterations = 100000\nend\nend\n");
    Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = d == 0 ? 0.013 : d == 1 ? -0.027 : 0.036;
    const double dt = 0.1;
    body.set_velocity([&](const Point<dim> &x) {
      const Case<dim> solution = exact(x - centre);
      return solution.velocity - dt * solution.force;
    });
    Viscosity<dim>(body.prm.dynamics.viscosity).advance(body.state, body.fit, dt);

    const Mesh<dim> &mesh  = *body.state.mesh;
    double           error = 0, size = 0, worst = 0, largest = 0;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (body.domain.is_liquid_face(f))
        {
          const double u = exact(mesh.face_centre(f) - centre).velocity * mesh.face_normal[f];
          const double e = body.state.u.local_element(f) - u;
          error += body.domain.face_mass[f] * e * e;
          size += body.domain.face_mass[f] * u * u;
          worst   = std::max(worst, std::abs(e));
          largest = std::max(largest, std::abs(u));
        }
    out() << dim << "D, level " << level << ", " << mapping << std::setprecision(3) << ": "
          << std::sqrt(Utilities::MPI::sum(error, comm) / Utilities::MPI::sum(size, comm)) << ", "
          << Utilities::MPI::max(worst, comm) / Utilities::MPI::max(largest, comm) << std::endl;
  }

  template <int dim>
  void
  check_all(const MPI_Comm &comm, const std::vector<unsigned int> &levels)
  {
    for (const char *mapping :
         {"hybrid", "face coupled", "face fitted FLIP", "face fitted PIC", "node FLIP", "node PIC"})
      for (const unsigned int level : levels)
        check<dim>(comm, mapping, level);
  }
} // namespace

void
start(const int argc, char **argv)
{
  run(argc, argv, check_all<2>, check_all<3>, [](const MPI_Comm &comm) {
    check_all<2>(comm, {4, 5});
    check_all<3>(comm, {3});
  });
}

const Test test("viscosity/traction_free", start);
} // namespace tests::viscosity_traction_free
