// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Liquid between a turning cylinder (radius 0.25, angular velocity 4) and a still one
// (radius 0.5), both embedded: case B5 of the verification. The angular momentum
// of the steady flow u = A r + B / r; the solid as a velocity and as a position.
// Argument: level.

#include "../tests.h"
#include "../run_scene.h"

namespace tests::scenes_moving_solids
{
double
relative_error(const MPI_Comm &comm, const unsigned int level, const std::string &motion)
{
  const std::string text =
    "set End time = 0.4\nset Frame interval = 10\nset Maximum time step = 0.05\n"
    "subsection Domain\nset Lower corner = -0.55, -0.55\nset Upper corner = 0.55, 0.55\nend\n"
    "subsection Mesh\nset Surface level = " +
    std::to_string(level) + "\nset Interior level = " + std::to_string(level) +
    "\nset Air level = 3\nend\n"
    "subsection Material\nset Density = 1\nset Viscosity = 1\nend\n"
    "subsection Gravity\nset Acceleration = 0; 0\nend\n"
    "subsection Surface tracking\nset Volume correction = false\nend\n"
    "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 5\nend\n"
    "subsection Solid 1\nset Shape = sphere\nset Invert = true\nset Centre = 0, 0\n"
    "set Radius = 0.5\nend\n"
    "subsection Solid 2\nset Shape = sphere\nset Centre = 0, 0\nset Radius = 0.25\n" +
    motion + "\nend\n";
  const auto   rows = run_scene<2>(comm, text, 2);
  const double a = 0.25, b = 0.5, omega = 4;
  const double A     = -omega * a * a / (b * b - a * a), B = -A * b * b;
  const double exact = 2 * numbers::PI *
                       (A * (std::pow(b, 4) - std::pow(a, 4)) / 4 + B * (b * b - a * a) / 2);
  return rows.back().at("Angular momentum (kg m^2/s)") / exact - 1;
}

void
start(const int argc, char **argv)
{
  const unsigned int level = argc > 1 ? std::stoi(argv[1]) : 4;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const std::string motion : {"set Angular velocity = 4", "set Rotation = 4*t"})
      {
        const double error = relative_error(comm, level, motion);
        if (level > 5 && Utilities::MPI::this_mpi_process(comm) == 0)
          std::cout << motion << ": " << error << std::endl;
        out() << motion << ": angular momentum off by " << std::setprecision(3) << 100 * error
              << " %" << std::endl;
      }
  });
}

const Test test("scenes/moving_solids", start);
} // namespace tests::scenes_moving_solids
