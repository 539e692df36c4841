// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Steps turned off one by one, seen by probes: liquid that fills a box that slips turns in
// a vortex (case B1) or falls freely; a ball that keeps its shape, and a probe in the air.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_switches
{
namespace
{
  std::string
  steps(const std::string &off)
  {
    std::string text = "subsection Steps\n";
    for (const std::string name : {"Surface", "Advection", "Viscosity", "Pressure"})
      if (off.find(name) != std::string::npos)
        text += "set " + name + " = false\n";
    return text + "end\n";
  }

  /// The same in 2D and in the x-y plane in 3D.
  template <int dim>
  std::string
  scene(const std::string &x, const std::string &u, const std::string &g)
  {
    const std::string last = dim == 2 ? "" : "; 0", middle = dim == 2 ? "" : ", 0.5";
    const std::string level = dim == 2 ? "4" : "3";
    return "set End time = 0.05\nset Frame interval = 0.05\nset Maximum time step = 0.01\n"
           "set Maximum CFL number = 10\n"
           "subsection Domain\nset Wall condition = free slip\nend\n"
           "subsection Mesh\nset Surface level = " + level + "\nset Interior level = " + level +
           "\nset Air level = " + level +
           "\nend\nsubsection Material\nset Density = 2\nset Viscosity = 0.2\nend\n"
           "subsection Gravity\nset Acceleration = " + g + last + "\nend\n"
           "subsection Liquid 1\nset Velocity = " + u + last + "\n" + x + "end\n"
           "subsection Probe 1\nset Position = 0.5, 0.4" + middle + "\nend\n"
           "subsection Probe 2\nset Position = 0.9, 0.9" + middle + "\nend\n";
  }

  template <int dim>
  void
  check(const MPI_Comm &comm, const std::string &name, const std::string &text, const std::string &off)
  {
    const auto rows = run_scene<dim>(comm, text + steps(off) + tolerance("1e-11"), 0, 1, 0, 2);
    const Row &first = rows.front(), &last = rows.back();
    const auto value = [](const double x) { return std::abs(x) < 1e-5 ? 0. : x; };
    out().precision(5);
    out() << dim << "D, " << name << ", without " << off << ": velocity "
          << value(first.at("Probe 1 velocity x (m/s)")) << " to "
          << value(last.at("Probe 1 velocity x (m/s)")) << ", "
          << value(last.at("Probe 1 velocity y (m/s)")) << "; second probe "
          << value(last.at("Probe 2 velocity x (m/s)")) << ", pressure "
          << value(last.at("Probe 2 pressure (Pa)")) << "; volume drift "
          << value(last.at("Volume drift")) << ", height of the middle "
          << last.at("Centre of mass y (m)") << ", divergence "
          << (last.at("Maximum divergence (1/s)") < 1e-5 ? "small" : "not small") << std::endl;
  }
} // namespace

template <int dim>
void
check(const MPI_Comm &comm)
{
  const std::string full = "set Shape = half space\nset Centre = 0, 10" +
                           std::string(dim == 2 ? "" : ", 0") + "\nset Normal = 0, 1" +
                           (dim == 2 ? "" : ", 0") + "\n";
  const std::string vortex =
    scene<dim>(full, "sin(pi * x) * cos(pi * y); -cos(pi * x) * sin(pi * y)", "0; 0");
  check<dim>(comm, "vortex", vortex, "Surface");
  if constexpr (dim == 2)
    {
      check<dim>(comm, "vortex", vortex, "Surface, Advection");
      check<dim>(comm, "vortex", vortex, "Surface, Advection, Viscosity");
    }
  check<dim>(comm, "vortex", vortex, "Surface, Advection, Pressure");
  const std::string ball = scene<dim>("", "1; 0", "0; -1");
  check<dim>(comm, "ball", ball, "Surface");
  check<dim>(comm, "ball", ball, "Viscosity, Pressure");
}

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
  });
}

const Test test("scenes/switches", start);
} // namespace tests::scenes_switches
