// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Liquid between a turning cylinder (radius 0.25, angular velocity 4) and a still one
// (radius 0.5), both embedded: case B5 of the verification. The angular momentum
// of the steady flow u = A r + B / r; the solid as a velocity and as a position.
// A ball that dips in and out of a pool beside a stirrer: where the contact line goes up and down each step is off by
// 0.05 % of the volume, halves as much as wholes, and are not taken for it.
// A belt that moves up out of the floor, of the box or of a solid, beside a pool: where it leaves the floor it sweeps nothing. (Else it drains
// what is under its way in the cell there, wherever the surface is.)
// Solids that leave the box, of which a part stays, and that go on without end.
// Argument: level.

#include "../tests.h"
#include "../run_scene.h"

namespace tests::scenes_moving_solids
{
double
relative_error(const MPI_Comm &comm, const unsigned int level, const std::string &motion)
{
  const std::string text =
    "set End time = 0.4\nset Frame interval = 10\nset Maximum time step = 0.05\n"
    "subsection Domain\nset Lower corner = -0.55, -0.55\nset Upper corner = 0.55, 0.55\nend\n"
    "subsection Mesh\nset Surface level = " +
    std::to_string(level) + "\nset Interior level = " + std::to_string(level) +
    "\nset Air level = 3\nend\n"
    "subsection Material\nset Density = 1\nset Viscosity = 1\nend\n"
    "subsection Gravity\nset Acceleration = 0; 0\nend\n"
    "subsection Surface tracking\nset Volume correction = false\nend\n"
    "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 5\nend\n"
    "subsection Solid 1\nset Shape = sphere\nset Invert = true\nset Centre = 0, 0\n"
    "set Radius = 0.5\nend\n"
    "subsection Solid 2\nset Shape = sphere\nset Centre = 0, 0\nset Radius = 0.25\n" +
    motion + "\nend\n";
  const auto   rows = run_scene<2>(comm, text, 2);
  const double a = 0.25, b = 0.5, omega = 4;
  const double A     = -omega * a * a / (b * b - a * a), B = -A * b * b;
  const double exact = 2 * numbers::PI *
                       (A * (std::pow(b, 4) - std::pow(a, 4)) / 4 + B * (b * b - a * a) / 2);
  return rows.back().at("Angular momentum (kg m^2/s)") / exact - 1;
}

void
stir(const MPI_Comm &comm)
{
  const auto rows = run_scene<2>(
    comm,
    "set End time = 0.4\nset Frame interval = 0.1\nset Maximum time step = 0.02\n"
    "subsection Mesh\nset Surface level = 6\nend\nsubsection Material\nset Viscosity = 5\nend\n"
    "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0.45\nset Normal = 0, 1\nend\n"
    "subsection Solid 1\nset Shape = box\nset Lower corner = 0.42, 0.3\nset Upper corner = 0.58, 0.34\n"
    "set Centre of rotation = 0.5, 0.32\nset Angular velocity = 6\nend\n"
    "subsection Solid 2\nset Centre = 0.2, 0.3\nset Radius = 0.08\nset Displacement = 0; 0.15 * sin(5 * t)\nend\n",
    2);
  double repetitions = 0, drift = 0;
  for (const Row &row : rows)
    {
      repetitions += row.at("Repetitions");
      drift = std::max(drift, std::abs(row.at("Drift before correction")));
    }
  out() << "stirred pool: at most 2 of 20 steps repeated: " << (repetitions <= 2 ? "yes" : "no")
        << ", off by less than 0.2 % in each: " << (drift < 2e-3 ? "yes" : "no") << std::endl;
}

/// What the pool wins, over the belt's way: the thickness of the layer (leaves). A floor at a height of 0 is that of the box, which
/// is @p m metres large; all else scales with it.
template <int dim>
double
won_beside_belt(const MPI_Comm &comm, const double floor, const double m = 1)
{
  const double       speed = 0.2, end = 0.2;
  const unsigned int level = dim == 3 ? 4 : 6;
  const auto         along = [](const double x, const double y, const std::string &between) {
    std::ostringstream text;
    text << std::setprecision(17) << x << between << (dim == 3 ? "0" + between : "") << y;
    return text.str();
  };
  const auto half_space = [&](const std::string &name, const double x, const double y, const double n_x, const double n_y, const std::string &more) {
    return "subsection " + name + "\nset Shape = half space\nset Centre = " + along(x * m, y * m, ", ") +
           "\nset Normal = " + along(n_x, n_y, ", ") + "\n" + more + "end\n";
  };
  const auto rows =
    run_scene<dim>(comm,
                   "set End time = " + std::to_string(end) + "\nset Frame interval = 10\nset Maximum time step = 0.02\n"
                   "subsection Domain\nset Upper corner = " + (dim == 3 ? std::to_string(m) + ", " : "") + std::to_string(m) + ", " +
                     std::to_string(m) + "\nend\nsubsection Mesh\nset Surface level = " + std::to_string(level) + "\nend\n"
                   "subsection Gravity\nset Acceleration = " + along(0, -9.81 * m, "; ") +
                     "\nend\nsubsection Material\nset Viscosity = " + std::to_string(150 * m * m) + "\nend\n" +
                     half_space("Liquid 1", 0, 0.5, 0, 1, "") +
                     half_space("Solid 1", 0.1, 0, 1, 0, "set Velocity = " + along(0, speed * m, "; ") + "\n") +
                     (floor > 0 ? half_space("Solid 2", 0, floor, 0, 1, "") : ""),
                   floor > 0 ? 2 : 1);
  double won = 0;
  for (const Row &row : rows)
    won += row.at("Drift before correction") * row.at("Liquid volume (m^" + std::to_string(dim) + ")") / std::pow(m, dim);
  return won / (speed * end) * (1 << level);
}

void
leave_floors(const MPI_Comm &comm)
{
  const auto bounded = [](const double won, const double bound) {
    return std::abs(won) < bound ? "yes" : "no: " + std::to_string(won);
  };
  for (const double floor : {0., 0.15})
    out() << "belt out of a floor at " << floor << ": the pool wins or loses less than 0.1 leaves of its way: "
          << bounded(won_beside_belt<2>(comm, floor), 0.1) << ", 3D: " << bounded(won_beside_belt<3>(comm, floor), 0.1) << std::endl;
  out() << "the same in a pool of a kilometre: "
        << bounded(won_beside_belt<2>(comm, 0.15, 1000) - won_beside_belt<2>(comm, 0.15), 1e-6) << std::endl;
}

/// A solid in a pool, a text, moves by a way (m) in the direction @p d: is it in the box still?
template <int dim>
void
leave_box(const MPI_Comm &comm, const std::string &name, const std::string &solid, const unsigned int d, const double way)
{
  std::string motion;
  for (unsigned int e = 0; e < dim; ++e)
    motion += (e > 0 ? "; " : "") + (e == d ? std::to_string(way) + " * t" : std::string("0"));
  const auto rows = run_scene<dim>(
                 comm,
                 "set End time = 1\nset Frame interval = 0.25\nset Maximum time step = 0.25\nset Maximum CFL number = 20\n"
                 "subsection Mesh\nset Surface level = 3\nset Interior level = 2\nset Air level = 2\nend\n"
                 "subsection Material\nset Viscosity = 1e6\nend\nsubsection Liquid 1\nset Shape = half space\nset Centre = 0.5, " +
                   std::string(dim == 2 ? "0.4\nset Normal = 0, 1" : "0.5, 0.4\nset Normal = 0, 0, 1") + "\nend\nsubsection Solid 1\n" + solid +
                   "\nset Displacement = " + motion + "\nend\n",
                 1);
  out() << dim << "D: " << name << ", by " << way << " m: t = " << rows.back().at("Time (s)")
        << (has_logged(comm, dim, "Solid 1 has left the box") ? ", has left" : ", is there still") << std::endl;
}

/// What is narrower than a leaf is in the box as long as a part of it is, and what moves along itself goes on without end.
void
leave_box(const MPI_Comm &comm)
{
  const std::string rod = "set Shape = capsule\nset Radius = 0.01\n", half_space = "set Shape = half space\n";
  for (const double way : {0.6, 2.})
    {
      leave_box<2>(comm, "rod", rod + "set Start = 0.52, 0.1\nset End = 0.52, 0.7", 1, way);
      leave_box<3>(comm, "rod", rod + "set Start = 0.52, 0.5, 0.1\nset End = 0.52, 0.5, 0.7", 2, way);
    }
  leave_box<2>(comm, "belt", half_space + "set Normal = 0, 1\nset Centre = 0, 0.2", 0, 20);
  leave_box<3>(comm, "belt", half_space + "set Centre = 0, 0, 0.2", 0, 20);
  leave_box<2>(comm, "wall", half_space + "set Normal = -1, 0", 0, 20);
  leave_box<3>(comm, "ball", "set Radius = 0.2", 0, 20);
  leave_box<2>(comm, "waves", "set Shape = expression\nset Expression = y - 0.3 - 0.1*sin(x)", 0, 20);
}

void
start(const int argc, char **argv)
{
  const unsigned int level = argc > 1 ? std::stoi(argv[1]) : 4;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const std::string motion : {"set Angular velocity = 4", "set Rotation = 4*t"})
      {
        const double error = relative_error(comm, level, motion);
        if (level > 5 && Utilities::MPI::this_mpi_process(comm) == 0)
          std::cout << motion << ": " << error << std::endl;
        out() << motion << ": angular momentum off by " << std::setprecision(3) << 100 * error
              << " %" << std::endl;
      }
    stir(comm);
    leave_floors(comm);
    leave_box(comm);
  });
}

const Test test("scenes/moving_solids", start);
} // namespace tests::scenes_moving_solids
