// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Standing waves without viscosity, 32 leaves long on four leaves of depth and a thirtieth of a leaf high, swing as fast as
// linear theory has it, wherever the surface lies between nodes: it keeps up with its markers.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_small_waves
{
namespace
{
  /// What the frequency is off, of a surface that lies so many leaves above nodes.
  template <int dim>
  double
  error(const MPI_Comm &comm, const double above)
  {
    constexpr double  h = 1. / 16, k = numbers::PI, n_steps = 80; // a period
    const double      depth = (4 + above) * h, omega = std::sqrt(k * std::tanh(k * depth)), period = 2 * numbers::PI / omega;
    const std::string up = dim == 2 ? "y" : "z", along = dim == 2 ? "; " : "; 0; ", beside = dim == 2 ? ", " : ", 0.125, ";
    const std::string level = dim == 2 ? "3" : "2", end = std::to_string(0.55 * period);
    const auto        rows = run_scene<dim>(comm,
                                     "set End time = " + end + "\nset Frame interval = " + end + "\nset Maximum time step = " +
                                       std::to_string(period / n_steps) +
                                       "\nsubsection Domain\nset Wall condition = free slip\nset Upper corner = 1, " +
                                       (dim == 2 ? "" : "0.25, ") + "0.5\nend\nsubsection Mesh\nset Surface level = " + level +
                                       "\nset Interior level = " + level + "\nset Air level = 1\nend\n" +
                                       "subsection Material\nset Density = 1\nset Viscosity = 0\nend\n" +
                                       "subsection Gravity\nset Acceleration = 0" + along + "-1\nend\n" +
                                       "subsection Liquid 1\nset Shape = expression\nset Expression = " + up + " - " +
                                       std::to_string(depth) + " - 0.03/16*cos(pi*x)\nend\n" +
                                       "subsection Probe 1\nset Position = 0.5" + beside + std::to_string(0.5 * depth) + "\nend\n",
                                     0,
                                     1,
                                     0,
                                     1);
    const auto        u    = [&](const unsigned int n) { return rows[n].at("Probe 1 velocity x (m/s)"); };
    for (unsigned int n = 2; n < rows.size(); ++n)
      if (u(n - 1) * u(n) < 0) // half a period after it was at rest
        {
          const double before = rows[n - 1].at("Time (s)"), after = rows[n].at("Time (s)");
          return 0.5 * period / (before + (after - before) * u(n - 1) / (u(n - 1) - u(n))) - 1;
        }
    return 1;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    for (const double above : {0.25, 0.75})
      out() << "2D: " << above << " leaves above nodes, frequency "
            << (std::abs(error<2>(comm, above)) < 0.005 ? "within 0.5 %" : "OFF") << std::endl;
    out() << "3D: 0.25 leaves above nodes, frequency " << (std::abs(error<3>(comm, 0.25)) < 0.002 ? "within 0.2 %" : "OFF")
          << std::endl;
  });
}

const Test test("scenes/small_waves", start);
} // namespace tests::scenes_small_waves
