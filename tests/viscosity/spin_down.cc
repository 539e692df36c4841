// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A free disc of radius R that turns, u_theta = J1(l r/R), by viscous steps alone: the
// decay rate over nu/R^2. Full stress: l = 5.1356223, rate 26.3746164 (case A4). Laplacian:
// l = 1.8411838, rate 3.38995772, the mode in which a rigid rotation is wrongly damped
// (case A1); with the full stress rigid rotation must keep its energy. Arguments: levels, settings.

#include "../tests.h"
#include "../body.h"

#include <iomanip>

namespace tests::viscosity_spin_down
{
namespace
{
  constexpr double radius = 0.3;

  Tensor<1, 2>
  turning(const Point<2> &x, const double l)
  {
    const Tensor<1, 2> r = x - Point<2>(0.503, 0.491);
    const double       s = r.norm() / radius;
    const double       w = l == 0 ? 1 : s > 0 ? std::cyl_bessel_j(1, l * s) / s : l / 2;
    Tensor<1, 2>       u;
    u[0] = -w * r[1] / radius;
    u[1] = w * r[0] / radius;
    return u;
  }

  /// Decay rate of the part of u in its initial shape, by which ten steps of
  /// backward Euler would have the same result, over nu/R^2.
  double
  decay_rate(const MPI_Comm    &comm,
             const std::string &mapping,
             const std::string &stress_model,
             const double       l,
             const unsigned int level)
  {
    Body<2> body(comm,
                 graded_mesh(level) + "subsection Material\nset Viscosity = 1000\nend\n" +
                   "subsection Liquid 1\nset Radius = 0.3\nset Centre = 0.503, 0.491\nend\n" +
                   "subsection Viscosity\nset Mapping = " + mapping +
                   "\nset Stress model = " + stress_model + "\nend\n" + tolerance("1e-13") +
                   // the mapping face coupled does not reach this tolerance with smaller ones
                   "subsection Pressure\nset Minimum theta = 0.01\nend\n");
    body.set_velocity([&](const Point<2> &x) { return turning(x, l); });
    const treacle::Vector start = body.state.u;
    const auto            part  = [&](const treacle::Vector &u) {
      double sum = 0;
      for (LocalIndex f = 0; f < body.state.mesh->n_owned_faces(); ++f)
        sum += body.domain.face_mass[f] * u.local_element(f) * start.local_element(f);
      return Utilities::MPI::sum(sum, comm);
    };
    const double         dt = 1e-3 * radius * radius; // nu = 1
    const Viscosity<2> viscosity(body.prm.dynamics.viscosity);
    for (unsigned int step = 0; step < 10; ++step)
      viscosity.advance(body.state, body.fit, dt);
    return (std::pow(part(start) / part(body.state.u), 0.1) - 1) / dt * radius * radius;
  }

  void
  check(const MPI_Comm &comm, const std::vector<unsigned int> &levels)
  {
    for (const char *mapping :
         {"hybrid", "face coupled", "face fitted FLIP", "face fitted PIC", "node FLIP", "node PIC"})
      for (const unsigned int level : levels)
        {
          const double kept = decay_rate(comm, mapping, "full", 0, level);
          out() << "level " << level << ", " << mapping << std::setprecision(4) << ": laplacian "
                << decay_rate(comm, mapping, "laplacian", 1.8411838, level) << " (3.38995772), full "
                << decay_rate(comm, mapping, "full", 5.1356223, level)
                << " (26.3746164), full and rigid "
                << (std::abs(kept) < 1e-8 ? "below 1e-8" : std::abs(kept) < 0.2 ? "below 0.2" : "too large")
                << std::endl;
        }
  }
} // namespace

void
start(const int argc, char **argv)
{
  const auto levels = tests::levels(arguments(argc, argv), 0);
  if (levels.empty())
    on_1_2_3_ranks([](const MPI_Comm &comm) { check(comm, {4, 5}); });
  else
    check(MPI_COMM_WORLD, levels);
}

const Test test("viscosity/spin_down", start);
} // namespace tests::viscosity_spin_down
