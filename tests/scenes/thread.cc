// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A thread half a leaf thick hangs on a disc and swings, without gravity: it has the mass of its
// liquid, and no part of it is thrown.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_thread
{
void
start(const int, char **)
{
  out() << std::setprecision(3);
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    const auto rows = run_scene<2>(
      comm,
      "set End time = 0.02\nset Frame interval = 0.005\nset Maximum time step = 0.005\n"
      "subsection Mesh\nset Surface level = 5\nset Interior level = 5\nend\n"
      "subsection Gravity\nset Acceleration = 0; 0\nend\n"
      "subsection Material\nset Viscosity = 0.1\nend\n"
      "subsection Liquid 1\nset Centre = 0.31, 0.52\nset Radius = 0.15\nend\n"
      "subsection Liquid 2\nset Shape = box\nset Lower corner = 0.4, 0.508\n"
      "set Upper corner = 0.75, 0.525\nset Velocity = 0; 1\nend\n",
      0,
      2);
    double speed = 0, rise = 0, least = std::numeric_limits<double>::max();
    for (const Row &row : rows)
      {
        const double kinetic = row.at("Nodal kinetic energy (J)");
        speed                = std::max(speed, row.at("Maximum speed (m/s)"));
        least                = std::min(least, kinetic);
        rise                 = std::max(rise, (kinetic - least) / rows[0].at("Nodal kinetic energy (J)"));
      }
    out() << "2D, a thread of 1 m/s: fastest "
          << (speed < 1.2 ? "less than 1.2 m/s" : "TOO FAST: " + std::to_string(speed))
          << ", its energy rises by "
          << (rise < 0.1 ? "less than 10 %" : "TOO MUCH: " + std::to_string(rise)) << std::endl;
  });
}

const Test test("scenes/thread", start);
} // namespace tests::scenes_thread
