// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Liquids without viscosity that slide on one another in a full box win no energy, however long the steps: two that stand side by side, one half
// as heavy again as the other, which flows over it, and two layers of one. On three ranks.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_shear
{
struct Sliding
{
  std::string  name, end_time, cfl, density, velocity;
  double       least; ///< of the energy (J) that changes its form
  unsigned int steps; ///< at most
};

void
slide(const Sliding &scene)
{
  const auto rows = run_scene<2>(MPI_COMM_WORLD,
                                 "set End time = " + scene.end_time + "\nset Frame interval = " + scene.end_time +
                                   "\nset Maximum time step = 1\nset Maximum CFL number = " + scene.cfl +
                                   "\nsubsection Domain\nset Wall condition = free slip\nend\n"
                                   "subsection Mesh\nset Surface level = 6\nset Interior level = 6\nset Air level = 2\nend\n"
                                   "subsection Material\nset Density = " +
                                   scene.density +
                                   "\nset Viscosity = 0\nset Transport = advected\nend\n"
                                   "subsection Liquid 1\nset Shape = expression\nset Expression = -1\nset Velocity = " +
                                   scene.velocity + "\nend\n",
                                 0,
                                 1);
  double most = 0, released = rows[0].at("Kinetic energy (J)");
  for (const Row &row : rows)
    {
      most     = std::max(most, energy(row) - energy(rows[0]));
      released = std::max(released, rows[0].at("Potential energy (J)") - row.at("Potential energy (J)"));
    }
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << rows.size() - 1 << " steps, most " << most / released << " of " << released << " J" << std::endl; // for a person
  out() << scene.name << ": " << (released > scene.least ? "slides" : "HARDLY MOVES") << ", wins "
        << (most < 5e-3 * released ? "less than 0.5 %" : "TOO MUCH") << " of its energy in "
        << (rows.size() - 1 <= scene.steps ? "as few steps as it may take" : "MANY STEPS") << std::endl;
}

void
start(const int, char **)
{
  slide({"one flows over the other", "0.8", "4", "if(x < 0.5, 1.5, 1)", "0; 0", 0.4, 40});
  slide({"two layers", "2", "9", "1", "tanh((y - 0.5) / 0.03); 0.1 * sin(2 * pi * x) * exp(-abs(y - 0.5) / 0.1)", 0.2, 40});
}

const Test test("scenes/shear", start);
} // namespace tests::scenes_shear
