// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Standing waves without viscosity, 32 leaves long on four leaves of depth and a thirtieth of a leaf high, swing as fast as
// linear theory has it, wherever the surface lies between nodes: it keeps up with its markers. And such waves between two liquids that are carried along.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_small_waves
{
namespace
{
  /// Waves along x, pi (1/m) a metre, in a box of half a metre that slips, under a gravity of 1 m/s^2.
  template <int dim>
  struct Wave
  {
    static constexpr double k = numbers::PI;
    double                  depth; ///< of the liquid that swings (m)
    double                  omega; ///< by linear theory (1/s)
    unsigned int            level;
    std::string             liquid;
  };

  template <int dim>
  const std::string up = dim == 2 ? "y" : "z";

  /// Of a free surface that lies so many leaves above nodes.
  template <int dim>
  Wave<dim>
  surface_wave(const double above)
  {
    Wave<dim> wave{(4 + above) / 16, 0, dim == 2 ? 3 : 2, ""};
    wave.omega  = std::sqrt(wave.k * std::tanh(wave.k * wave.depth));
    wave.liquid = "subsection Material\nset Density = 1\nend\nsubsection Liquid 1\nset Shape = expression\nset Expression = " +
                  up<dim> + " - " + std::to_string(wave.depth) + " - 0.03/16*cos(pi*x)\nend\n";
    return wave;
  }

  /// Of two layers that fill the box, the lower one half as heavy again as the other, and carried along.
  template <int dim>
  Wave<dim>
  internal_wave(const double above)
  {
    const unsigned int level = dim == 2 ? 4 : 2, leaves = 2 << level; // a metre
    Wave<dim>          wave{0.25 + above / leaves, 0, level, ""};
    const auto         depth = [&](const double h) { return 1 / std::tanh(wave.k * h); };
    wave.omega               = std::sqrt(wave.k * 0.5 / (1.5 * depth(wave.depth) + depth(0.5 - wave.depth)));
    wave.liquid = "subsection Material\nset Density = if(" + up<dim> + " < " + std::to_string(wave.depth) + " + 0.03/" +
                  std::to_string(leaves) + "*cos(pi*x), 1.5, 1)\nset Transport = advected\nend\n" +
                  "subsection Liquid 1\nset Shape = expression\nset Expression = -1\nend\n";
    return wave;
  }

  /// What the frequency is off; 1 where it does not swing.
  template <int dim>
  double
  error(const MPI_Comm &comm, const Wave<dim> &wave)
  {
    constexpr double  n_steps = 80; // a period
    const double      period  = 2 * numbers::PI / wave.omega;
    const std::string along = dim == 2 ? "; " : "; 0; ", beside = dim == 2 ? ", " : ", 0.125, ";
    const std::string level = std::to_string(wave.level), end = std::to_string(0.55 * period);
    const auto        rows = run_scene<dim>(comm,
                                     "set End time = " + end + "\nset Frame interval = " + end + "\nset Maximum time step = " +
                                       std::to_string(period / n_steps) +
                                       "\nsubsection Domain\nset Wall condition = free slip\nset Upper corner = 1, " +
                                       (dim == 2 ? "" : "0.25, ") + "0.5\nend\nsubsection Mesh\nset Surface level = " + level +
                                       "\nset Interior level = " + level + "\nset Air level = 1\nend\n" +
                                       "subsection Material\nset Viscosity = 0\nend\n" +
                                       "subsection Gravity\nset Acceleration = 0" + along + "-1\nend\n" + wave.liquid +
                                       "subsection Probe 1\nset Position = 0.5" + beside + std::to_string(0.5 * wave.depth) + "\nend\n",
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

  template <int dim>
  void
  check(const MPI_Comm &comm, const std::string &name, const Wave<dim> &wave, const double percent)
  {
    const double off = 100 * std::abs(error<dim>(comm, wave));
    out() << dim << "D " << name << ": frequency " << (off < percent ? "within " : "NOT WITHIN ") << percent << " %" << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm, "surface, 0.25 leaves above nodes", surface_wave<2>(0.25), 0.5);
    check<2>(comm, "surface, 0.75 leaves above nodes", surface_wave<2>(0.75), 0.5);
    check<3>(comm, "surface, 0.25 leaves above nodes", surface_wave<3>(0.25), 0.2);
    check<2>(comm, "layers, 0.25 leaves above nodes", internal_wave<2>(0.25), 3);
    check<2>(comm, "layers, 0.6 leaves above nodes", internal_wave<2>(0.6), 3);
    check<3>(comm, "layers, 0.25 leaves above nodes", internal_wave<3>(0.25), 5);
  });
}

const Test test("scenes/small_waves", start);
} // namespace tests::scenes_small_waves
