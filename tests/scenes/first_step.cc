// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A pool that is given a velocity into walls and floor, which slip: it keeps its volume and gains
// no energy. A ball at rest falls by g t^2 / 2 from the first step on, and so does one that is
// thrown up, whose steps double where it is slow.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_first_step
{
namespace
{
  template <int dim>
  std::string
  corner(const std::string &value)
  {
    return dim == 2 ? value + ", " + value : value + ", " + value + ", " + value;
  }

  template <int dim>
  std::string
  mesh(const std::string &level)
  {
    return "subsection Mesh\nset Surface level = " + level + "\nset Interior level = " + level +
           "\nset Air level = 2\nend\n";
  }

  template <int dim>
  void
  pushed_pool(const MPI_Comm &comm)
  {
    const std::string up  = dim == 2 ? "0, 1" : "0, 0, 1";
    const auto        rows = run_scene<dim>(
      comm,
      mesh<dim>(dim == 2 ? "4" : "3") +
        "set End time = 0.09\nset Frame interval = 0.03\nset Maximum time step = 0.03\n"
        "subsection Domain\nset Wall condition = default: free slip\nend\n"
        "subsection Surface tracking\nset Volume correction = false\nend\n"
        "subsection Liquid 1\nset Shape = half space\nset Centre = " +
        corner<dim>("0.3") + "\nset Normal = " + up + "\nset Velocity = " +
        (dim == 2 ? "-1.5; -1.1" : "-1.5; 0; -1.1") + "\nend\n");
    const double first = energy(rows.front());
    double       worst = 0;
    for (const Row &row : rows)
      worst = std::max(worst, energy(row) / first);
    const std::string volume = "Liquid volume (m^" + std::to_string(dim) + ")";
    out() << dim << "D pool: volume " << rows.at(1).at(volume) / rows.at(0).at(volume)
          << " of the first after a step, energy at most " << worst << " of the first" << std::endl;
  }

  constexpr double g = 9.81; // m/s^2

  /// How far the liquid is above where it began (m).
  template <int dim>
  double
  raised(const std::vector<Row> &rows, const Row &row)
  {
    const double volume = rows.front().at("Liquid volume (m^" + std::to_string(dim) + ")");
    return (row.at("Potential energy (J)") - rows.front().at("Potential energy (J)")) / (1000 * g * volume);
  }

  template <int dim>
  void
  fall(const MPI_Comm &comm)
  {
    const auto rows = run_scene<dim>(
      comm,
      mesh<dim>(dim == 2 ? "5" : "4") +
        "set End time = 0.04\nset Frame interval = 0.02\nset Maximum time step = 0.02\n"
        "subsection Liquid 1\nset Centre = " + corner<dim>("0.5") + "\nset Radius = 0.2\nend\n");
    out() << dim << "D ball, fallen by";
    for (const Row &row : rows)
      if (const double t = row.at("Time (s)"); t > 0)
        out() << ' ' << -raised<dim>(rows, row) / (0.5 * g * t * t);
    out() << " of g t^2 / 2" << std::endl;
  }

  template <int dim>
  void
  thrown(const MPI_Comm &comm)
  {
    const auto rows = run_scene<dim>(
      comm,
      mesh<dim>(dim == 2 ? "5" : "4") +
        "set End time = 0.25\nset Frame interval = 0.05\nset Maximum time step = 0.05\n"
        "set Maximum CFL number = " + (dim == 2 ? "3" : "1.5") +
        "\nsubsection Liquid 1\nset Centre = " + (dim == 2 ? "0.57, 0.47" : "0.57, 0.5, 0.4") +
        "\nset Radius = 0.12\nset Velocity = " + (dim == 2 ? "-1.07; 1.83" : "-1.07; 0; 1.83") + "\nend\n");
    double worst = 0, growth = 0, before = 0;
    for (const Row &row : rows)
      {
        const double t = row.at("Time (s)");
        worst          = std::max(worst, std::abs(raised<dim>(rows, row) - (1.83 - 0.5 * g * t) * t));
        if (before > 0)
          growth = std::max(growth, row.at("Time step size (s)") / before);
        before = row.at("Time step size (s)");
      }
    out() << dim << "D ball, thrown, off by " << worst / (0.5 * g * 0.25 * 0.25)
          << " of g t^2 / 2 at most, steps grow by " << growth << " at most" << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  out() << std::setprecision(3);
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    pushed_pool<2>(comm);
    pushed_pool<3>(comm);
    fall<2>(comm);
    fall<3>(comm);
    thrown<2>(comm);
    thrown<3>(comm);
  });
}

const Test test("scenes/first_step", start);
} // namespace tests::scenes_first_step
