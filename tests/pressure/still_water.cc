// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Water at rest on a graded mesh with a sphere immersed, flat and with gravity
// tilted as the surface is: it stays at rest to rounding where no theta is
// clamped (case C1 of the verification); without viscosity, its surface on the sides of leaves, where dual centres are,
// to what the clamped ones make. A full box in a force that has a potential, also on leaves of three sizes. Liquid that is heavier below, by little
// and little or all at once (where it is carried along in a full box, for nodes in the air have what is carried beside them, and all at once on leaves of one size). Argument: number of steps, level.

#include "../tests.h"
#include "../run_scene.h"

namespace tests::pressure_still_water
{
enum class Surface
{
  flat,
  tilted,
  on_leaves
};

template <int dim>
void
check(const MPI_Comm &comm, const Surface surface, const unsigned int n_steps, const unsigned int level)
{
  const bool        tilted = surface == Surface::tilted, on_leaves = surface == Surface::on_leaves;
  const std::string name = tilted ? "tilted" : on_leaves ? "on leaves" : "flat", height = on_leaves ? "0.5" : "0.51";
  Tensor<1, dim> normal;
  normal[dim - 1] = 1;
  if (tilted)
    for (unsigned int d = 0; d + 1 < dim; ++d)
      normal[d] = 0.2 / (d + 1);
  normal /= normal.norm();
  std::ostringstream text, components;
  text.precision(17);
  const char *separator = "";
  for (unsigned int d = 0; d < dim; ++d, separator = "; ")
    {
      components.precision(17);
      components << separator << -9.81 * normal[d];
    }
  text << "set End time = " << 0.01 * n_steps << "\nset Frame interval = 10\n"
       << "set Maximum time step = 0.01\n"
       << "subsection Domain\nset Wall condition = free slip\nend\n"
       << "subsection Mesh\nset Surface level = " << level
       << "\nset Interior level = 2\nset Air level = 2\nset Band width = 2\nend\n"
       << "subsection Material\nset Density = " << (on_leaves ? 1 : 1000) << "\nset Viscosity = " << (on_leaves ? 0 : 1) << "\nend\n"
       << "subsection Gravity\nset Acceleration = " << components.str() << "\nend\n"
       << "subsection Liquid 1\nset Shape = half space\nset Centre = "
       << (dim == 2 ? "0.5, " : "0.5, 0.5, ") << height << "\nset Normal = ";
  for (unsigned int d = 0; d < dim; ++d)
    text << (d ? ", " : "") << normal[d];
  text << "\nend\nsubsection Solid 1\nset Shape = sphere\nset Radius = 0.15\nset Centre = "
       << (dim == 2 ? "0.45, 0.3" : "0.45, 0.5, 0.3") << "\nend\n"
       << tolerance("1e-13");

  const auto   rows  = run_scene<dim>(comm, text.str(), 1);
  const double speed = rows.back().at("Maximum speed (m/s)") / std::sqrt(9.81 * 0.51);
  const double clamped = rows.back().at("Clamped faces");
  if (n_steps > 10) // for a person
    std::cout << dim << "D " << name << ": maximum speed " << speed
              << " sqrt(g h), " << clamped << " clamped faces" << std::endl;
  out() << dim << "D " << name << ": " << rows.size() - 1 << " steps, "
        << (on_leaves ? "" : std::to_string(std::lround(clamped)) + " clamped faces, ") << "speed "
        << (speed < 1e-8 ? "below 1e-8" : speed < 1e-5 ? "below 1e-5" : "TOO LARGE")
        << " sqrt(g h)" << std::endl;
}

/// A force of the fourth degree's potential, which no constant is.
template <int dim>
void
full(const MPI_Comm &comm)
{
  const auto rows = run_scene<dim>(comm,
                                   "set End time = 0.2\nset Frame interval = 0.2\nset Maximum time step = 0.1\n"
                                   "subsection Domain\nset Wall condition = free slip\nend\n"
                                   "subsection Mesh\nset Surface level = 4\nset Interior level = 2\n"
                                   "set Size = if(sqrt((x - 0.3)^2 + (y - 0.3)^2) < 0.1, 0.06, 1)\nend\n"
                                   "subsection Gravity\nset Acceleration = -9*(x - 0.4)^3; 5*(y - 0.4)" +
                                     std::string(dim == 2 ? "" : "; 3 - z") +
                                     "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 0\nend\n"
                                     "subsection Liquid 1\nset Shape = expression\nset Expression = -1\nend\n" +
                                     tolerance("1e-13"));
  out() << dim << "D full: speed " << (rows.back().at("Maximum speed (m/s)") < 1e-9 ? "below 1e-9" : "TOO LARGE") << " m/s"
        << std::endl;
}

template <int dim>
void
layered(const MPI_Comm    &comm,
        const std::string &name,
        const std::string &density,
        const std::string &transport,
        const double       height,
        const std::string &size = "if(x < 0.3, 0.06, 1)")
{
  const std::string up   = dim == 2 ? "y" : "z";
  const auto        rows = run_scene<dim>(comm,
                                   "set End time = 0.2\nset Frame interval = 0.2\nset Maximum time step = 0.1\n"
                                   "subsection Domain\nset Wall condition = free slip\nend\n"
                                   "subsection Mesh\nset Surface level = 4\nset Interior level = 2\n"
                                   "set Size = " + size + "\nset Air level = 2\nset Band width = 1\nend\n"
                                   "subsection Material\nset Density = " + density + "\nset Viscosity = 0\nset Transport = " + transport +
                                     "\nend\nsubsection Liquid 1\nset Shape = expression\nset Expression = " + up + " - " + std::to_string(height) + "\nend\n" +
                                     tolerance("1e-13"));
  out() << dim << "D " << name << ": speed " << (rows.back().at("Maximum speed (m/s)") < 1e-8 ? "below 1e-8" : "TOO LARGE") << " m/s"
        << std::endl;
}

template <int dim>
void
layered(const MPI_Comm &comm)
{
  const std::string up = dim == 2 ? "y" : "z";
  layered<dim>(comm, "layers of a formula", "if(" + up + " < 0.47, 1.5, 1)", "fixed", 0.81);
  layered<dim>(comm, "density that falls", "1.5 - 0.5*" + up, "fixed", 0.81);
  layered<dim>(comm, "density that falls, carried along", "1.5 - 0.5*" + up, "advected", 2);
  layered<dim>(comm, "layers carried along", "if(" + up + " < 0.47, 1.5, 1)", "advected", 2, "0.06");
}

void
start(const int argc, char **argv)
{
  const unsigned int n_steps = argc > 1 ? std::stoi(argv[1]) : 3;
  const unsigned int level   = argc > 2 ? std::stoi(argv[2]) : 3;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const Surface surface : {Surface::flat, Surface::tilted, Surface::on_leaves})
      {
        check<2>(comm, surface, n_steps, level);
        check<3>(comm, surface, n_steps, level);
      }
    full<2>(comm);
    full<3>(comm);
    layered<2>(comm);
    layered<3>(comm);
  });
}

const Test test("pressure/still_water", start);
} // namespace tests::pressure_still_water
