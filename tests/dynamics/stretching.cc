// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Sheets of two and four leaves and threads of 2.7 that two solids pull: the force is Trouton's, 4 mu H U / L of a sheet (2D) and 3 mu A U / L of a
// thread, wherever the surface cuts the leaves. What the ends add does not depend on the length: so it is told by two lengths. And a beam
// between two solids that sags by its weight, against the same with leaves of half the size.
// Argument: level.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::dynamics_stretching
{
namespace
{
  constexpr double viscosity = 1e6, speed = 0.01, density = 1000, gravity = 10;

  /// Liquid between solids before @p left and behind @p right.
  template <int dim>
  std::string
  between(const double left, const double right, const bool is_pulled, const unsigned int level, const std::string &liquid)
  {
    const std::string zero = dim == 2 ? "" : "; 0", l = std::to_string(level);
    const auto solid = [&](const std::string &k, const double lower, const double upper, const double velocity) {
      return "subsection Solid " + k + "\nset Shape = box\nset Lower corner = " + std::to_string(lower) + ", -3" +
             (dim == 2 ? "" : ", -3") + "\nset Upper corner = " + std::to_string(upper) + ", 3" + (dim == 2 ? "" : ", 3") +
             "\nset Velocity = " + std::to_string(velocity) + "; 0" + zero + "\nend\n";
    };
    const double pull = is_pulled ? speed / 2 : 0;
    return "set End time = 0.002\nset Frame interval = 1\nset Maximum time step = 0.001\nsubsection Mesh\nset Surface level = " +
           l + "\nset Interior level = " + l + "\nset Air level = 2\nend\nsubsection Gravity\nset Acceleration = 0; " +
           (dim == 2 ? "" : "0; ") + (is_pulled ? "0" : std::to_string(-gravity)) + "\nend\nsubsection Material\nset Density = " +
           std::to_string(density) + "\nset Viscosity = " + std::to_string(viscosity) + "\nend\n" + solid("1", -3, left, -pull) +
           solid("2", right, 4, pull) + "subsection Liquid 1\n" + liquid + "end\n";
  }

  /// Of @p thickness, a sheet's or a thread's diameter, and @p length, with its middle at a height; times what its speed and force make of
  /// its length.
  template <int dim>
  double
  effective_length(const MPI_Comm &comm, const unsigned int level, const double thickness, const double height, const double length)
  {
    const std::string y = std::to_string(height), lower = std::to_string(height - thickness / 2),
                      upper = std::to_string(height + thickness / 2);
    const std::string liquid =
      dim == 2 ? "set Shape = box\nset Lower corner = 0, " + lower + "\nset Upper corner = 1, " + upper + "\n" :
                 "set Shape = cylinder\nset Axis = 1, 0, 0\nset Length = 1\nset Centre = 0.5, " + y + ", " + y +
                   "\nset Radius = " + std::to_string(thickness / 2) + "\n";
    const auto   rows  = run_scene<dim>(comm, between<dim>(0.5 - length / 2, 0.5 + length / 2, true, level, liquid), 2);
    const double force = rows.back().at("Solid 1 force x (N)");
    const double area  = dim == 2 ? 4 * thickness : 3 * numbers::PI / 4 * thickness * thickness;
    return viscosity * area * speed / std::abs(force);
  }

  template <int dim>
  void
  stretch(const MPI_Comm &comm, const unsigned int level, const std::vector<double> &thicknesses, const double bound)
  {
    const double h = std::pow(0.5, level);
    double       most = 0;
    for (const double leaves : thicknesses)
      for (const double height : {0.5, 0.5 + 0.3 * h})
        {
          const auto   length = [&](const double l) { return effective_length<dim>(comm, level, leaves * h, height, l); };
          const double off    = (length(0.75) - length(0.45)) / 0.3 - 1;
          if (Utilities::MPI::this_mpi_process(comm) == 0)
            std::cout << dim << "D, " << leaves << " leaves, at " << height << ": " << -off << std::endl;
          most = std::max(most, std::abs(off));
        }
    out() << dim << "D: force of what is " << thicknesses.front() << " leaves thick, or more, off by less than " << bound * 100 << " %: "
          << (most < bound ? "yes" : "NO, " + std::to_string(most)) << std::endl;
  }

  /// How fast the middle of a beam sinks.
  double
  sag(const MPI_Comm &comm, const unsigned int level, const double thickness, const double height)
  {
    const auto rows = run_scene<2>(comm,
                                   between<2>(0.103, 0.897, false, level,
                                              "set Shape = box\nset Lower corner = 0, " + std::to_string(height - thickness / 2) +
                                                "\nset Upper corner = 1, " + std::to_string(height + thickness / 2) + "\n"),
                                   2);
    return rows.back().at("Maximum speed (m/s)");
  }
} // namespace

void
start(const int argc, char **argv)
{
  const unsigned int level = argc > 1 ? std::atoi(argv[1]) : 5;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    stretch<2>(comm, level, {2, 4}, 0.015);
    stretch<3>(comm, level - 1, {2.7}, 0.03); // what is round has that much less of its area
    const double coarse = sag(comm, level, 0.113, 0.507), fine = sag(comm, level + 1, 0.113, 0.507);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      std::cout << "beam: " << coarse / fine - 1 << std::endl;
    out() << "2D: a beam of four leaves sags as with leaves of half the size: "
          << (std::abs(coarse / fine - 1) < 0.03 ? "yes" : "NO") << std::endl;
  });
}

const Test test("dynamics/stretching", start);
} // namespace tests::dynamics_stretching
