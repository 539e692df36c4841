// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A free disc and sphere that rotate and move as a rigid body, viscosity 1e3
// (case A1): what the viscous step alone takes from momentum and energy, with
// each mapping. Only hybrid and the face-fitted ones must take nothing. Arguments: dimension, levels,
// settings; then the losses are relative, of angular momentum, kinetic energy and linear
// momentum. "Liquid 1/Shape=triangle mesh" and so on make another body.

#include "../tests.h"
#include "../body.h"

#include <iomanip>

namespace tests::viscosity_rigid_rotation
{
namespace
{
  template <int dim>
  Loss
  loss(const MPI_Comm &comm, const std::string &mapping, const unsigned int level)
  {
    Body<dim> body(comm,
                   "subsection Mesh\nset Surface level = " + std::to_string(level) +
                     "\nset Interior level = 2\nset Air level = 2\nset Band width = 2\nend\n" +
                     rigid_rotation<dim>(mapping) +
                     "subsection Linear solvers\nsubsection Viscosity\n"
                     "set Maximum iterations = 20000\nend\nend\n");
    return lost_by_viscosity(body);
  }

  constexpr std::array<const char *, 6> mappings = {
    {"hybrid", "face fitted FLIP", "face fitted PIC", "face coupled", "node FLIP", "node PIC"}};

  template <int dim>
  void
  check(const MPI_Comm &comm, const std::string &mapping, const unsigned int level)
  {
    const Loss lost    = loss<dim>(comm, mapping, level);
    const auto size_of = [](const double x) {
      return x < 1e-10 ? "below 1e-10" : x < 1e-2 ? "below 1e-2" : "below 1";
    };
    out() << dim << "D, " << mapping << ": angular momentum lost " << size_of(lost.angular_momentum)
          << ", kinetic energy " << size_of(lost.kinetic_energy) << std::endl;
  }

  template <int dim>
  void
  print(const MPI_Comm &comm, const std::vector<unsigned int> &levels)
  {
    for (const char *mapping : mappings)
      for (const unsigned int level : levels)
        {
          const Loss lost = loss<dim>(comm, mapping, level);
          out() << dim << "D, level " << level << ", " << mapping << std::setprecision(3) << ": "
                << lost.angular_momentum << ", " << lost.kinetic_energy << ", "
                << lost.linear_momentum << std::endl;
        }
  }
} // namespace

void
start(const int argc, char **argv)
{
  run(argc, argv, print<2>, print<3>, [&](const MPI_Comm &comm) {
    for (const char *mapping : mappings)
      {
        check<2>(comm, mapping, 3);
        check<3>(comm, mapping, 3);
      }
  });
}

const Test test("viscosity/rigid_rotation", start);
} // namespace tests::viscosity_rigid_rotation
