// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A steady vortex in a full box that slips, without viscosity, in steps of two thirds of a leaf: read linearly between nodes its velocity would gain a fifth of
// its energy in a second. In 3D the same along z.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::transport_vortex
{
namespace
{
  template <int dim>
  void
  check(const MPI_Comm &comm, const std::string &end_time)
  {
    const std::string z    = dim == 2 ? "" : "; 0";
    const auto        rows = run_scene<dim>(comm,
                                     "set End time = " + end_time + "\nset Frame interval = " + end_time +
                                       "\nset Maximum time step = 0.04\n"
                                       "subsection Domain\nset Wall condition = free slip\nend\n"
                                       "subsection Mesh\nset Surface level = 4\nset Interior level = 4\nend\n"
                                       "subsection Gravity\nset Acceleration = 0; 0" + z +
                                       "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 0\nend\n"
                                       "subsection Liquid 1\nset Shape = expression\nset Expression = -1\n"
                                       "set Velocity = sin(pi*x)*cos(pi*y); -cos(pi*x)*sin(pi*y)" + z + "\nend\n");
    const double      first = rows.front().at("Kinetic energy (J)"), last = rows.back().at("Kinetic energy (J)");
    out() << dim << "D: " << rows.size() - 1 << " steps, energy "
          << (std::abs(last / first - 1) < 0.01 ? "within 1 %" : "OFF") << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) { check<2>(comm, "1"); });
  check<3>(MPI_COMM_WORLD, "0.4");
}

const Test test("transport/vortex", start);
} // namespace tests::transport_vortex
