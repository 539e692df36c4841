// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Stiff liquid takes steps as long as its motion allows, not as gravity would: a wave on a liquid of
// depth 1 levels out at the exact rate in few steps (C3: 0.145546628 g h / nu), stays level in steps
// of five times the time that takes, with nothing said of the largest step; what turns, or may be driven, has the usual ones; and goes at once with the solid that carries it when that falls, faster than it would.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_creeping
{
namespace
{
  constexpr double rate = 0.145546628e-4; // 1/s, in all dimensions: the wave is plane

  template <int dim>
  std::vector<Row>
  level_out(const MPI_Comm &comm, const double end, const double frame)
  {
    const std::string y = dim == 2 ? "y" : "z", level = dim == 2 ? "3" : "2";
    return run_scene<dim>(
      comm,
      "set End time = " + std::to_string(end) + "\nset Frame interval = " + std::to_string(frame) +
        "\nsubsection Domain\n" +
        "set Upper corner = " + (dim == 2 ? "1, 1.5" : "1, 0.5, 1.5") +
        "\nset Wall condition = default: free slip; bottom: no slip\nend\n"
        "subsection Mesh\nset Root cells = " + (dim == 2 ? "2" : "1") + "\nset Surface level = " + level +
        "\nset Interior level = " + level + "\nset Air level = 2\nend\n" +
        "subsection Gravity\nset Acceleration = " + (dim == 2 ? "0; -1" : "0; 0; -1") + "\nend\n" +
        "subsection Material\nset Density = 1\nset Viscosity = 1e4\nend\n" +
        "subsection Liquid 1\nset Shape = expression\nset Expression = " + y +
        " - 1 - 0.01*cos(pi*x)\nend\n");
  }

  template <int dim>
  void
  relax(const MPI_Comm &comm)
  {
    const std::string top  = std::string("Liquid maximum ") + (dim == 2 ? "y" : "z") + " (m)";
    const auto        rows = level_out<dim>(comm, 1e5, 1e4);
    const Row        &last = rows.back(), &before = rows.at(rows.size() - 3);
    const double      found =
      std::log((before.at(top) - 1) / (last.at(top) - 1)) / (last.at("Time (s)") - before.at("Time (s)"));
    out() << dim << "D: levels out in " << rows.size() - 1 << " steps, at a rate off by "
          << 100 * (found / rate - 1) << " %" << std::endl;
  }

  void
  stay_level(const MPI_Comm &comm)
  {
    const auto rows   = level_out<2>(comm, 50 / rate, 5 / rate);
    double     height = 0;
    for (const Row &row : rows)
      if (row.at("Time (s)") > 15 / rate)
        height = std::max(height, std::abs(row.at("Liquid maximum y (m)") - 1));
    out() << "2D: stays level in steps of " << rate * rows.back().at("Time step size (s)")
          << " over the rate: " << (height < 2e-4 ? "yes" : "no") << std::endl;
  }

  /// Steps to 0.4 s with nothing said of the largest.
  void
  steps_of(const MPI_Comm    &comm,
           const std::string &what,
           const std::string &scene,
           const unsigned int n_solids   = 0,
           const unsigned int n_emitters = 0)
  {
    const auto rows = run_scene<2>(comm,
                                   "set End time = 0.4\nset Frame interval = 0.2\nsubsection Mesh\nset Surface level = 4\nset Interior level = 4\n"
                                   "set Air level = 3\nend\nsubsection Material\nset Density = 1\nset Viscosity = 1e4\nend\n" +
                                     scene,
                                   n_solids,
                                   1,
                                   n_emitters);
    out() << "2D: " << what << " in " << rows.size() - 1 << " steps" << std::endl;
  }

  void
  do_not_creep(const MPI_Comm &comm)
  {
    // no node sees it change
    steps_of(comm,
             "turns by 2",
             "subsection Gravity\nset Acceleration = 0; 0\nend\n"
             "subsection Liquid 1\nset Radius = 0.2\nset Velocity = 5 * (0.5 - y); 5 * (x - 0.5)\nend\n");
    const std::string pool = "subsection Liquid 1\nset Shape = box\nset Lower corner = -1, -1\nset Upper corner = 2, 0.5\nend\n";
    steps_of(comm, "rests", pool);
    steps_of(comm, "rests until gravity turns", pool + "subsection Gravity\nset Acceleration = 10 * sin(max(t - 0.3, 0)); -10\nend\n");
    steps_of(comm,
             "rests until a solid comes",
             pool + "subsection Solid 1\nset Shape = sphere\nset Radius = 0.1\nset Centre = 0.5, 0.7\nset Displacement = 0; -max(t - 0.3, 0)\nend\n",
             1);
    steps_of(comm,
             "rests until an emitter pours",
             pool + "subsection Emitter 1\nset Shape = sphere\nset Radius = 0.1\nset Centre = 0.5, 0.8\nset Velocity = 0; -max(t - 0.3, 0)\nend\n",
             0,
             1);
  }

  template <int dim>
  void
  fall(const MPI_Comm &comm)
  {
    const std::string h = dim == 2 ? "" : "0.4, ", H = dim == 2 ? "" : "0.6, ", level = dim == 2 ? "5" : "4";
    const auto        rows = run_scene<dim>(
      comm,
      "set End time = 2.1\nset Frame interval = 0.2\nset Maximum time step = 0.2\n"
      "subsection Domain\nset Upper corner = " + std::string(dim == 2 ? "1, 2" : "1, 1, 2") +
        "\nend\nsubsection Mesh\nset Surface level = " + level + "\nset Interior level = " + level +
        "\nset Air level = 3\nend\nsubsection Material\nset Density = 1\nset Viscosity = 100\nend\n"
        "subsection Liquid 1\nset Shape = box\nset Lower corner = 0.4, " + h + "1.3\nset Upper corner = 0.6, " + H +
        "1.6\nend\nsubsection Solid 1\nset Shape = box\nset Lower corner = 0.3, " + (dim == 2 ? "" : "0.3, ") +
        "1.2\nset Upper corner = 0.7, " + (dim == 2 ? "" : "0.7, ") + "1.3\nset Velocity = 0; " +
        (dim == 2 ? "" : "0; ") + "if(t < 1.8, 0, -min(4, 20*(t - 1.8)))\nend\n",
      1);
    double repeated = 0;
    for (const Row &row : rows)
      repeated += row.at("Repetitions");
    const std::string centre = std::string("Centre of mass ") + (dim == 2 ? "y" : "z") + " (m)";
    out() << dim << "D: rests for " << std::count_if(rows.begin() + 1, rows.end(), [](const Row &row) {
      return row.at("Time (s)") < 1.8 + 1e-9;
    }) << " steps, " << repeated << " repeated, falls by " << rows.front().at(centre) - rows.back().at(centre)
          << " in " << rows.size() - 1 << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    out() << std::setprecision(2);
    relax<2>(comm);
    relax<3>(comm);
    stay_level(comm);
    do_not_creep(comm);
    out() << std::setprecision(3);
    fall<2>(comm);
    fall<3>(comm);
  });
}

const Test test("scenes/creeping", start);
} // namespace tests::scenes_creeping
