// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Two liquids without viscosity stand side by side in a full box, one half as heavy again as the other, which flows over it:
// they win no energy where they slide on one another, in steps as long as they may be. On three ranks.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_two_liquids
{
void
start(const int, char **)
{
  const auto rows = run_scene<2>(MPI_COMM_WORLD,
                                 "set End time = 0.7\nset Frame interval = 0.7\nset Maximum time step = 0.7\n"
                                 "subsection Domain\nset Wall condition = free slip\nend\n"
                                 "subsection Mesh\nset Surface level = 6\nset Interior level = 6\nset Air level = 2\nend\n"
                                 "subsection Material\nset Density = if(x < 0.5, 1.5, 1)\nset Viscosity = 0\nset Transport = advected\nend\n"
                                 "subsection Liquid 1\nset Shape = expression\nset Expression = -1\nend\n",
                                 0,
                                 1);
  const auto energy = [](const Row &row) { return row.at("Kinetic energy (J)") + row.at("Potential energy (J)"); };
  double     most   = 0;
  for (const Row &row : rows)
    most = std::max(most, energy(row) - energy(rows[0]));
  const double released = rows[0].at("Potential energy (J)") - rows.back().at("Potential energy (J)");
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << rows.size() - 1 << " steps, most " << most / released << ", released " << released << std::endl; // for a person
  out() << "one flows over the other: " << (released > 0.4 ? "potential energy is released" : "HARDLY MOVES") << ", of which is won "
        << (most < 0.02 * released ? "less than 2 %" : "TOO MUCH") << std::endl;
}

const Test test("scenes/two_liquids", start);
} // namespace tests::scenes_two_liquids
