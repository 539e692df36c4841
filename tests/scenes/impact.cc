// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A block falls on the floor, and on a solid, by more than a leaf a step: what a step pushes into
// them comes out again in the same step, and the energy does not rise. Water that splashes in steps of six
// leaves, under an emitter, keeps its volume. A drop falls into a pool, 1.2 leaves a step, a block goes into it, 2.6 leaves a step, and a stream is poured into one: what air they enclose
// or draw in does not swallow liquid. A stiff disc that drifts into a wall does not bounce off, and a ring that falls by
// more than its thickness in a step does not go through a floor. What a plate of 1.6 leaves pushes out does not come out on its other side. A column without viscosity between walls that slip breaks down, and runs up the wall as a
// jet of two leaves, 2.7 leaves a step, without a gain of energy.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_impact
{
namespace
{
  template <int dim>
  std::string
  corner(const std::string &horizontal, const std::string &vertical)
  {
    return horizontal + (dim == 2 ? ", " : ", " + horizontal + ", ") + vertical;
  }

  template <int dim>
  void
  land(const MPI_Comm &comm, const std::string &name, const std::string &solid)
  {
    const std::string level = dim == 2 ? "4" : "3", dt = dim == 2 ? "0.05" : "0.1";
    const auto        rows  = run_scene<dim>(
      comm,
      "set End time = 0.4\nset Frame interval = " + dt + "\nset Maximum time step = " + dt +
        "\nsubsection Mesh\nset Surface level = " + level + "\nset Interior level = " + level +
        "\nset Air level = 2\nend\nsubsection Material\nset Viscosity = 10\nend\n"
        "subsection Liquid 1\nset Shape = box\nset Lower corner = " +
        corner<dim>("0.3", "0.45") + "\nset Upper corner = " + corner<dim>("0.7", "0.75") + "\nend\n" +
        solid,
      solid.empty() ? 0 : 1);
    double drift = 0, rise = 0, least = std::numeric_limits<double>::max();
    for (const Row &row : rows)
      {
        drift = std::max(drift, std::abs(row.at("Volume drift")));
        least = std::min(least, energy(row));
        rise  = std::max(rise, (energy(row) - least) / energy(rows.front()));
      }
    out() << dim << "D, on " << name << ": volume off by at most " << 100 * drift
          << " %, energy rises by " << 100 * rise << " % at most" << std::endl;
  }

  void
  splash(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(
      comm,
      "set End time = 1\nset Frame interval = 0.05\nset Maximum time step = 0.05\nset Maximum CFL number = 10\n"
      "subsection Domain\nset Wall condition = free slip\nend\n"
      "subsection Mesh\nset Surface level = 5\nset Interior level = 5\nset Air level = 2\nend\n"
      "subsection Material\nset Viscosity = 0\nend\n"
      "subsection Liquid 1\nset Centre = 0.6, 0.45\nset Radius = 0.2\nend\n"
      "subsection Emitter 1\nset Radius = 0.08\nset Centre = 0.25, 0.85\nset Velocity = 0; -2\nend\n",
      0,
      1,
      1);
    double drift = 0;
    for (const Row &row : rows)
      drift = std::max(drift, std::abs(row.at("Volume drift")));
    out() << "2D, a splash: volume off by "
          << (drift < 0.005 ? "less than 0.5 %" : "TOO MUCH, " + std::to_string(drift)) << std::endl;
  }

  void
  plunge(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(
      comm,
      "set End time = 0.4\nset Frame interval = 0.01\nset Maximum time step = 0.01\n"
      "subsection Mesh\nset Surface level = 6\nend\nsubsection Material\nset Viscosity = 10\nend\n"
      "subsection Liquid 1\nset Shape = box\nset Lower corner = 0, 0\nset Upper corner = 1, 0.3\nend\n"
      "subsection Liquid 2\nset Centre = 0.5, 0.6\nset Radius = 0.12\nend\n",
      0,
      2);
    double won = 0;
    for (const Row &row : rows)
      won += row.at("Drift before correction");
    out() << "2D, into a pool: won or lost before correction "
          << (std::abs(won) < 0.02 ? "less than 2 %" : "TOO MUCH") << std::endl;
  }

  /// A block goes into a pool, 2.6 leaves a step. What a step moves into the pool comes out again; where it fills the air before it with the
  /// pool's velocity, it is repeated. It would lose an eighth.
  void
  dive(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(
      comm,
      "set End time = 0.15\nset Frame interval = 0.15\nsubsection Mesh\nset Surface level = 6\nend\n"
      "subsection Material\nset Density = 1000\nset Viscosity = 10\nend\n"
      "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0.25\nset Normal = 0, 1\nend\n"
      "subsection Liquid 2\nset Shape = box\nset Lower corner = 0.45, 0.4\nset Upper corner = 0.55, 0.8\n"
      "set Velocity = 0; -3\nend\n",
      0,
      2);
    constexpr double block = 0.04; // m^2
    double           won   = 0;
    for (const Row &row : rows)
      won += row.at("Drift before correction") * row.at("Liquid volume (m^2)");
    out() << "2D, a block into a pool: won or lost before correction "
          << (std::abs(won) < 0.04 * block ? "less than 4 %" : "TOO MUCH, " + std::to_string(won / block)) << std::endl;
  }

  /// A stream is poured into a pool.
  template <int dim>
  std::vector<Row>
  pour(const MPI_Comm &comm, const std::string &text)
  {
    return run_scene<dim>(comm, text + "subsection Material\nset Density = 1000\nset Viscosity = 10\nend\n", 0, 1, 1);
  }

  /// What is won before correction between two times, of what is poured meanwhile.
  template <int dim>
  double
  won(const std::vector<Row> &rows, const double from, const double to)
  {
    const std::string power = dim == 2 ? " (m^2)" : " (m^3)";
    double            won = 0, poured = 0;
    for (unsigned int k = 1; k < rows.size(); ++k)
      if (const double time = rows[k].at("Time (s)"); time > from && time <= to)
        {
          won += rows[k].at("Drift before correction") * rows[k].at("Liquid volume" + power);
          poured += rows[k].at("Emitted volume" + power) - rows[k - 1].at("Emitted volume" + power);
        }
    return won / poured;
  }

  std::string
  less_than(const unsigned int percent, const double part)
  {
    return std::abs(part) < 0.01 * percent ? "less than " + std::to_string(percent) + " %" : "TOO MUCH, " + std::to_string(part);
  }

  /// Air that the stream draws in with it, in gaps thinner than a leaf, would swallow a third of what is poured.
  void
  pour_stretched(const MPI_Comm &comm)
  {
    const auto rows =
      pour<2>(comm,
            "set End time = 1.4\nset Frame interval = 0.05\n"
            "subsection Mesh\nset Surface level = 6\nset Interior level = 5\nend\n"
            "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0.25\nset Normal = 0, 1\nend\n"
            "subsection Emitter 1\nset Shape = box\nset Lower corner = 0.45, 0.9\nset Upper corner = 0.55, 1\n"
            "set Velocity = 0; -1\nend\n");
    out() << "2D, poured into a pool: won or lost before correction, of what is poured " << less_than(15, won<2>(rows, 0.8, 1.4001))
          << std::endl;
  }

  /// Nodes move the pool's surface about a stream of three leaves as sharply curved as a leaf: a seventh of what is poured would be lost.
  void
  pour_slowly(const MPI_Comm &comm)
  {
    const auto rows =
      pour<3>(comm,
            "set End time = 0.5\nset Frame interval = 0.05\n"
            "subsection Domain\nset Upper corner = 0.5, 0.5, 0.5\nend\n"
            "subsection Mesh\nset Surface level = 4\nset Interior level = 3\nend\n"
            "subsection Gravity\nset Acceleration = 0; 0; -1\nend\n"
            "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0, 0.2\nset Normal = 0, 0, 1\nend\n"
            "subsection Emitter 1\nset Shape = box\nset Lower corner = 0.2, 0.2, 0.4\nset Upper corner = 0.3, 0.3, 0.5\n"
            "set Velocity = 0; 0; -1.4\nend\n");
    const double in_air = won<3>(rows, 0, 0.1251); // it meets the pool in the next step
    out() << "3D, poured into a pool: won or lost before correction, of what is poured, in the air " << less_than(3, in_air)
          << ", in the pool " << less_than(7, won<3>(rows, 0.1251, 0.5001) - in_air) << " more" << std::endl;
  }

  void
  drift_into_wall(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(
      comm,
      "set End time = 0.25\nset Frame interval = 0.0125\nset Maximum time step = 0.0125\n"
      "subsection Domain\nset Wall condition = free slip\nend\n"
      "subsection Mesh\nset Surface level = 4\nset Interior level = 4\nend\n"
      "subsection Material\nset Density = 64\nset Viscosity = 4.7e6\nend\n"
      "subsection Liquid 1\nset Centre = 0.4368, 0.6472\nset Radius = 0.2318\n"
      "set Velocity = -1.255; -0.4746\nend\n");
    double back = 0;
    for (const Row &row : rows)
      back = std::max(back,
                      row.at("Linear momentum x (kg m/s)") /
                        std::abs(rows[0].at("Linear momentum x (kg m/s)")));
    out() << "2D, along a wall: comes back with "
          << (back < 0.05 ? "less than 5 %" : "TOO MUCH, " + std::to_string(back)) << std::endl;
  }

  void
  go_through(const MPI_Comm &comm)
  {
    const auto rows = run_scene<3>(
      comm,
      "set End time = 0.4\nset Frame interval = 0.05\nset Maximum time step = 0.05\nset Maximum CFL number = 3\n"
      "subsection Domain\nset Wall condition = free slip\nend\n"
      "subsection Mesh\nset Surface level = 4\nset Interior level = 4\nend\n"
      "subsection Material\nset Viscosity = 500\nend\n"
      "subsection Liquid 1\nset Shape = torus\nset Centre = 0.5, 0.5, 0.5\n"
      "set Radius = 0.14\nset Minor radius = 0.055\nend\n");
    double drift = 0;
    for (const Row &row : rows)
      drift = std::max(drift, std::abs(row.at("Volume drift")));
    out() << "3D, a ring that would go through the floor: volume off by "
          << (drift < 0.01 ? "less than 1 %" : "TOO MUCH, " + std::to_string(drift)) << std::endl;
  }

  /// A block lands flat: the way out is long, and led through the plate.
  void
  land_on_plate(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(comm,
                                   "set End time = 0.2\nset Frame interval = 0.04\nset Maximum time step = 0.04\n"
                                   "subsection Mesh\nset Surface level = 5\nend\n"
                                   "subsection Material\nset Viscosity = 50\nend\n"
                                   "subsection Liquid 1\nset Shape = box\nset Lower corner = 0.3, 0.463\n"
                                   "set Upper corner = 0.7, 0.65\nset Velocity = 0; -0.3\nend\n"
                                   "subsection Solid 1\nset Shape = box\nset Lower corner = 0.1, 0.4\n"
                                   "set Upper corner = 0.9, 0.45\nend\n",
                                   1);
    double lowest = 1;
    for (const Row &row : rows)
      lowest = std::min(lowest, row.at("Liquid minimum y (m)"));
    out() << "2D, flat on a plate: " << (lowest > 0.4 ? "stays above it" : "COMES THROUGH, " + std::to_string(lowest))
          << std::endl;
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    land<dim>(comm, "the floor", "");
    land<dim>(comm,
              "a solid",
              "subsection Solid 1\nset Shape = box\nset Lower corner = " + corner<dim>("-1", "-1") +
                "\nset Upper corner = " + corner<dim>("2", "0.22") + "\nend\n");
  }

  /// The waves of its jet were continued in time where they had been, not where the jet carried them: it grew them,
  /// and won volume, 2.5 % of the energy in the end.
  void
  break_dam(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(comm,
                                   "set End time = 0.46\nset Frame interval = 0.02\n"
                                   "subsection Domain\nset Wall condition = free slip\nend\n"
                                   "subsection Mesh\nset Surface level = 7\nset Interior level = 5\nend\n"
                                   "subsection Material\nset Viscosity = 0\nend\n"
                                   "subsection Liquid 1\nset Shape = box\nset Lower corner = 0, 0\nset Upper corner = 0.3, 0.5\nend\n",
                                   0);
    double most = 0;
    for (const Row &row : rows)
      most = std::max(most, energy(row) / energy(rows.front()) - 1);
    out() << "2D, a dam breaks: gains "
          << (most < 0.003 ? "less than 0.3 % of its energy" : "TOO MUCH, " + std::to_string(most)) << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  out() << std::setprecision(2);
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
    splash(comm);
    plunge(comm);
    dive(comm);
    if (Utilities::MPI::n_mpi_processes(comm) == 1) // a hundred steps
      {
        pour_stretched(comm);
        pour_slowly(comm);
        break_dam(comm);
      }
    drift_into_wall(comm);
    go_through(comm);
    land_on_plate(comm);
  });
}

const Test test("scenes/impact", start);
} // namespace tests::scenes_impact
