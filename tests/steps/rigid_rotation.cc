// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A free disc and sphere that rotate and move as a rigid body, viscosity 1e3
// (case A1): what the viscous step alone takes from momentum and energy, with
// each mapping. Only the face-fitted ones must take nothing. Argument: level.

#include "../tests.h"
#include "body.h"

using namespace tests;

template <int dim>
void
check(const MPI_Comm &comm, const std::string &mapping, const unsigned int level)
{
  Body<dim> body(comm,
                 "subsection Mesh\nset Surface level = " + std::to_string(level) +
                   "\nset Interior level = 2\nset Air level = 2\nset Band width = 2\nend\n" +
                   rigid_rotation<dim>(mapping) +
                   "subsection Linear solvers\nsubsection Viscosity\n"
                   "set Maximum iterations = 20000\nend\nend\n");
  const Loss loss = lost_by_viscosity(body);
  if (level > 5)
    print(body, mapping, loss);
  const auto size_of = [](const double x) {
    return x < 1e-10 ? "below 1e-10" : x < 1e-2 ? "below 1e-2" : "below 1";
  };
  out() << dim << "D, " << mapping << ": angular momentum lost " << size_of(loss.angular_momentum)
        << ", kinetic energy " << size_of(loss.kinetic_energy) << std::endl;
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int level = argc > 1 ? std::stoi(argv[1]) : 3;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const char *mapping :
         {"face fitted FLIP", "face fitted PIC", "face coupled", "node FLIP", "node PIC"})
      {
        check<2>(comm, mapping, level);
        check<3>(comm, mapping, level);
      }
  });
}
