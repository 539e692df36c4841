// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Solids in the liquid, where leaves would be larger than their edges and plates without them. A plate of two leaves of the surface between
// two pools, one twice as high, wherever it lies in its leaves: it holds. (With leaves of four nobody saw it, and the pools got level.) One
// of 0.6 leaves may leak: the log says so. Syrup
// in a box that turns, half full: its corners have as much room at any angle, so that volume need not be corrected. (By 0.4 % in each step.)
// Formulas for leaves and material count in the liquid, and are not asked elsewhere.

#include "../tests.h"
#include "../run_scene.h"

namespace tests::scenes_edges
{
/// @p leaves thick.
template <int dim>
void
plate(const MPI_Comm &comm, const double x, const double leaves)
{
  const auto        digits = [](const double number) { return std::to_string(number); };
  const std::string y = dim == 3 ? ", -1" : "", top = dim == 3 ? ", 2" : "";
  const auto        box = [&](const double from, const double to, const std::string &height) {
    return "set Shape = box\nset Lower corner = " + digits(from) + y + ", -1\nset Upper corner = " + digits(to) + top + ", " + height + "\nend\n";
  };
  const unsigned int level     = dim == 3 ? 4 : 6;
  const double       thickness = leaves / (1 << level);
  const auto         rows =
    run_scene<dim>(comm,
                   "set End time = 0.03\nset Frame interval = 0.03\nset Maximum time step = 0.01\nsubsection Domain\nset Wall condition = free slip\nend\n"
                   "subsection Mesh\nset Surface level = " + std::to_string(level) + "\nset Interior level = 2\nset Air level = 2\nend\n"
                   "subsection Material\nset Viscosity = 10\nend\nsubsection Liquid 1\n" +
                     box(-1, x + 0.75 * thickness, "0.8") + "subsection Liquid 2\n" + box(x + 0.75 * thickness, 2, "0.4") + "subsection Solid 1\n" +
                     box(x, x + thickness, "3"),
                   1,
                   2);
  const double speed = rows.back().at("Maximum speed (m/s)");
  const bool   is_warned = has_logged(comm, dim, "Solid 1 is thinner than a cell where");
  out() << dim << "D: plate of " << leaves << " leaves at " << x << " between pools: "
        << (speed < 0.01   ? is_warned ? "warned of, BUT HOLDS" : "holds" :
            is_warned ? "leaks as the log says" :
                        "LEAKS: " + digits(speed))
        << std::endl;
}

/// A coat on the floor, and one on a block of another solid, hold no liquid back.
void
coats(const MPI_Comm &comm)
{
  run_scene<2>(comm,
               "set End time = 0.001\nset Frame interval = 0.001\nsubsection Mesh\nset Surface level = 5\nend\n"
               "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0.4\nset Normal = 0, 1\nend\n"
               "subsection Solid 1\nset Shape = box\nset Lower corner = -1, -1\nset Upper corner = 2, 0.017\nend\n"
               "subsection Solid 2\nset Shape = box\nset Lower corner = 0.3, 0.01\nset Upper corner = 0.7, 0.2\nend\n"
               "subsection Solid 3\nset Shape = box\nset Lower corner = 0.3, 0.2\nset Upper corner = 0.7, 0.217\nend\n",
               3);
  out() << "coats of half a leaf: " << (has_logged(comm, 2, "is thinner than a cell where") ? "WARNED OF" : "no warning") << std::endl;
}

void
turning_box(const MPI_Comm &comm)
{
  const auto rows = run_scene<2>(comm,
                                 "set End time = 0.2\nset Frame interval = 0.2\nset Maximum time step = 0.02\n"
                                 "subsection Mesh\nset Surface level = 6\nend\nsubsection Material\nset Viscosity = 300\nend\n"
                                 "subsection Liquid 1\nset Shape = half space\nset Centre = 0.5, 0.5\nset Normal = 0, 1\n"
                                 "set Velocity = 0.5 - y; x - 0.5\nend\n"
                                 "subsection Solid 1\nset Shape = box\nset Invert = true\nset Lower corner = 0.3, 0.3\n"
                                 "set Upper corner = 0.7, 0.7\nset Centre of rotation = 0.5, 0.5\nset Rotation = t\nend\n",
                                 1);
  double sum = 0, most = 0;
  for (const Row &row : rows)
    {
      const double drift = std::abs(row.at("Drift before correction"));
      sum += drift;
      most = std::max(most, drift);
    }
  out() << "box that turns: off by less than 0.15 % in a step: " << (most < 1.5e-3 ? "yes" : "no") << ", 1 % in all ten: "
        << (sum < 1e-2 ? "yes" : "no") << std::endl;
}

/// Leaves of the pool and the air are asked for edges of solids, but formulas in the liquid alone: this one is negative in the air.
void
formula(const MPI_Comm &comm)
{
  const auto rows = run_scene<2>(comm,
                                 "set End time = 0.001\nset Frame interval = 0.001\nsubsection Mesh\nset Surface level = 4\n"
                                 "set Size = 0.05 + 0.2*(0.5 - y)\nend\n"
                                 "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0.3\nset Normal = 0, 1\nend\n"
                                 "subsection Solid 1\nset Shape = box\nset Lower corner = 0.4, 0.1\nset Upper corner = 0.5, 0.9\nend\n",
                                 1);
  out() << "formula that is negative in the air: steps " << rows.back().at("Time step number") << std::endl;
}

void
start(int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    for (const double x : {0.45, 0.5})
      plate<2>(comm, x, 2);
    plate<2>(comm, 0.45, 0.6);
    plate<3>(comm, 0.42, 2);
    plate<3>(comm, 0.42, 0.6);
    coats(comm);
    turning_box(comm);
    formula(comm);
  });
}

const Test test("scenes/edges", start);
} // namespace tests::scenes_edges
