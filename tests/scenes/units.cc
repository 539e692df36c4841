// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// What a slump does, and what its solves cost, does not depend on units: a block of a micrometre, or one of any density,
// is that of a metre once more. (Libraries that take what is below 1e-12 for zero made up to twenty times as many
// iterations of it, and other figures.) Nor on where it is, nor on how its numbers round: maps have
// coordinates of millions of metres. Rock that creeps does what honey does, though momentum spreads over 1e9 leaves in a step.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_units
{
namespace
{
  /// Of length, time and density, and the origin in metres.
  struct Units
  {
    double m, s, density, origin = 0;
  };

  /// Of viscosity and weight, @p stiffness times as large: where it is much, what happens does not depend on it.
  template <int dim>
  Row
  slump(const MPI_Comm &comm, const Units &unit, const double stiffness = 1)
  {
    const auto number = [](const double value) {
      std::ostringstream text;
      text << std::setprecision(17) << value;
      return text.str();
    };
    const auto point = [&](const double across, const double up) {
      std::string text;
      for (unsigned int d = 0; d + 1 < dim; ++d)
        text += number(unit.origin + across * unit.m) + ", ";
      return text + number(unit.origin + up * unit.m);
    };
    return run_scene<dim>(comm,
                          "set End time = " + number((dim == 2 ? 0.5 : 0.1) * unit.s) + "\nset Frame interval = " + number((dim == 2 ? 0.5 : 0.1) * unit.s) +
                            "\nset Maximum time step = " + number(0.05 * unit.s) +
                            "\nsubsection Domain\nset Lower corner = " + point(-1.25, 0) + "\nset Upper corner = " +
                            point(1.25, 1.25) + "\nend\nsubsection Mesh\nset Surface level = 4\nset Interior level = 3\nend\n"
                            "subsection Material\nset Density = " + number(unit.density) + "\nset Viscosity = " +
                            number(stiffness * unit.density * unit.m * unit.m / unit.s) +
                            "\nend\nsubsection Gravity\nset Acceleration = 0; " + (dim == 3 ? "0; " : "") +
                            number(-9.81 * stiffness * unit.m / (unit.s * unit.s)) +
                            "\nend\nsubsection Liquid 1\nset Shape = box\nset Lower corner = " + point(-0.5, -0.5) +
                            "\nset Upper corner = " + point(0.47, 0.8) + "\nend\n")
      .back();
  }

  /// The largest difference of width and height, relative.
  template <int dim>
  double
  difference(const Row &a, const Units &unit, const Row &b)
  {
    double most = 0;
    for (const char *const extent : {"Liquid maximum x (m)", dim == 2 ? "Liquid maximum y (m)" : "Liquid maximum z (m)"})
      most = std::max(most, std::abs((a.at(extent) - unit.origin) / (unit.m * b.at(extent)) - 1));
    return most;
  }

  /// The kinetic energy in these units.
  template <int dim>
  double
  energy_of_motion(const Row &row, const Units &unit)
  {
    return row.at("Kinetic energy (J)") / (unit.density * std::pow(unit.m, dim + 2) / (unit.s * unit.s));
  }

  template <int dim>
  void
  compare(const MPI_Comm &comm)
  {
    const Row one = slump<dim>(comm, {1, 1, 1});
    for (const auto &[name, unit] :
         std::map<std::string, Units>{{"micrometres", {1e-6, 1e-4, 1000}},
                                      {"much mass", {1, 1, 1e14}},
                                      {"thirds", {1. / 3, 1, 1}},
                                      {"far from the origin", {1, 1, 1, 4.5e6}}})
      {
        const Row row = slump<dim>(comm, unit);
        const double energy = energy_of_motion<dim>(row, unit) / energy_of_motion<dim>(one, {1, 1, 1});
        const double bound = 1e-6, digits = 2e-12 * unit.origin; // of the statistics
        out() << dim << "D, " << name << ": the same "
              << (difference<dim>(row, unit, one) < bound + digits && std::abs(energy - 1) < bound ? "yes" : "no")
              << ", iterations "
              << (std::abs(row.at("Viscosity iterations") - one.at("Viscosity iterations")) < 2 ? "too" : "not")
              << std::endl;
      }
    if (dim == 3)
      return;
    const Units planet{1e6, 1e12, 3300};
    const Row   rock = slump<dim>(comm, planet, 1e16);
    out() << dim << "D, rock: as what is stiff "
          << (difference<dim>(rock, planet, slump<dim>(comm, {1, 1, 1}, 1e4)) < 0.01 ? "yes" : "no")
          << ", left for the projection " << rock.at("Pressure iterations") << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    compare<2>(comm);
    compare<3>(comm);
  });
}

const Test test("scenes/units", start);
} // namespace tests::scenes_units
