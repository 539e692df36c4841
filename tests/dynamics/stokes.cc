// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Viscosity and pressure in one solve. A free ball that rotates and moves as a rigid body
// keeps its momentum, angular momentum and energy. A pool of two viscosities with a solid that
// moves through its surface, and a closed box that a turning solid stirs: free of
// divergence, and the same on 1, 2 and 3 ranks. A solve that may not iterate falls back. The
// iterations do not grow with mesh and viscosity, nor where a solid or an emitter all but closes cells. The default tolerance is
// enough where what is prescribed is stiff.

#include "../tests.h"
#include "../run_scene.h"

namespace tests::dynamics_stokes
{
namespace
{
  const std::string coupled =
    "subsection Viscosity\nset Pressure coupling = coupled\nend\n";

  template <int dim>
  std::string
  in_space(const std::string &in_plane, const std::string &last)
  {
    return in_plane + (dim == 2 ? "" : last) + "\n";
  }

  std::string
  mesh(const int level, const int interior_level = 3)
  {
    return "subsection Mesh\nset Surface level = " + std::to_string(level) +
           "\nset Interior level = " + std::to_string(interior_level) + "\nset Air level = 2\nend\n";
  }

  std::string
  steps(const double dt, const unsigned int n)
  {
    return "set End time = " + std::to_string(dt * n) + "\nset Frame interval = 10\n" +
           "set Maximum time step = " + std::to_string(dt) + "\nset Maximum CFL number = 10\n";
  }

  /// A free ball that turns, and what else its velocity says, keeps these to @p bound.
  template <int dim>
  void
  check_kept(const MPI_Comm                 &comm,
             const std::string              &name,
             const std::string              &velocity,
             const std::vector<std::string> &columns,
             const std::string              &bound)
  {
    const auto rows = run_scene<dim>(
      comm,
      steps(0.01, 2) + mesh(dim == 2 ? 4 : 3) +
        "subsection Material\nset Density = 1000\nset Viscosity = 1000\nend\n"
        "subsection Gravity\nset Acceleration = " +
        in_space<dim>("0; 0", "; 0") + "end\nsubsection Liquid 1\nset Radius = 0.25\nset Velocity = " +
        velocity +
        "end\nsubsection Steps\nset Surface = false\nset Advection = false\nend\n" + coupled +
        tolerance("1e-13"));
    out() << dim << "D, " << name << ':';
    for (const std::string &column : columns)
      {
        const double change = std::abs(rows.back().at(column) / rows.front().at(column) - 1);
        out() << ' ' << column << (change < std::stod(bound) ? " kept to " + bound : " CHANGES");
      }
    out() << std::endl;
  }

  template <int dim>
  void
  check_free_ball(const MPI_Comm &comm)
  {
    const std::string momentum = "Linear momentum x (kg m/s)",
                      turning  = dim == 2 ? "Angular momentum (kg m^2/s)" : "Angular momentum z (kg m^2/s)";
    check_kept<dim>(comm,
                    "rigid motion",
                    in_space<dim>("0.3 - 2*(y-0.5); 0.2 + 2*(x-0.5)", "; 0.1"),
                    {momentum, turning, "Kinetic energy (J)"},
                    "1e-10");
    check_kept<dim>(comm,
                    "stretching",
                    in_space<dim>("0.3 - 2*(y-0.5) + x-0.5; 0.2 + 2*(x-0.5) - (y-0.5)", "; 0.1 + x-0.5"),
                    {momentum, turning},
                    "1e-8");
  }

  void
  print(const std::string &name, const Row &row)
  {
    out() << name << ": kinetic energy " << row.at("Kinetic energy (J)") << ", dissipation "
          << row.at("Viscous dissipation (W)") << ", force " << row.at("Solid 1 force x (N)")
          << ", divergence "
          << (row.at("Maximum divergence (1/s)") < 1e-7 ? "below 1e-7" : "TOO LARGE")
          << ", fallbacks " << row.at("Fallbacks") << std::endl;
  }

  template <int dim>
  std::string
  pool()
  {
    return steps(0.02, 3) + mesh(dim == 2 ? 4 : 3) +
           "subsection Domain\nset Wall condition = default: free slip; bottom: no slip\nend\n"
           "subsection Material\nset Density = 2\nset Viscosity = if(x < 0.5, 1, 100)\nend\n"
           "subsection Gravity\nset Acceleration = " +
           in_space<dim>(dim == 2 ? "0; -1" : "0; 0", "; -1") +
           "end\nsubsection Liquid 1\nset Shape = half space\nset Centre = " +
           in_space<dim>("0.5, 0.5", ", 0.5") + "set Normal = " +
           in_space<dim>(dim == 2 ? "0.1, 1" : "0.1, 0", ", 1") +
           "end\nsubsection Solid 1\nset Radius = 0.17\nset Centre = " +
           in_space<dim>("0.45, 0.5", ", 0.5") +
           "set Velocity = " + in_space<dim>("1; 0.2", "; 0.1") + "end\n" + tolerance("1e-12");
  }

  /// A block on a floor around a disc, on a graded mesh, and a stream that falls on it.
  void
  check_iterations(const MPI_Comm &comm)
  {
    for (const char *viscosity : {"1", "1e8"})
      for (const int level : {5, 7})
        {
          const double n =
            run_scene<2>(comm,
                         steps(0.02, 1) + mesh(level, level - 1) +
                           "subsection Material\nset Density = 1\nset Viscosity = " + viscosity +
                           "\nend\nsubsection Gravity\nset Acceleration = 0; -1\nend\n"
                           "subsection Liquid 1\nset Shape = expression\n"
                           "set Expression = max(abs(x - 0.5), abs(y - 0.3)) - 0.31\nend\n"
                           "subsection Solid 1\nset Radius = 0.12\nset Centre = 0.52, 0.33\nend\n"
                           "subsection Emitter 1\nset Shape = box\nset Lower corner = 0.456, 0.79\n"
                           "set Upper corner = 0.5565, 1\nset Velocity = 0; -1\nend\n" +
                           coupled,
                         1,
                         1,
                         1)
              .back()
              .at("Viscosity iterations");
          out() << "2D, level " << level << ", viscosity " << viscosity << ": "
                << (n >= 1 && n <= 60 ? "at most 60" : std::to_string(n)) << " iterations" << std::endl;
        }
  }

  /// A stiff stream meets a stiff block: what the emitter prescribes is nearly all of the right-hand side, the motion of what hangs on it
  /// next to nothing of that, and yet right with the default tolerance.
  void
  check_stiff_stream(const MPI_Comm &comm)
  {
    const auto run = [&](const std::string &tolerance) {
      return run_scene<2>(comm,
                          steps(0.02, 8) + mesh(4) +
                            "subsection Material\nset Density = 1\nset Viscosity = 4e5\nend\n"
                            "subsection Liquid 1\nset Shape = box\nset Lower corner = 0.3, 0.4\nset Upper corner = 0.6, 0.62\nend\n"
                            "subsection Emitter 1\nset Shape = sphere\nset Radius = 0.08\nset Centre = 0.5, 0.85\n"
                            "set Velocity = 0; -2\nend\n" +
                            coupled + tolerance,
                          0,
                          1,
                          1);
    };
    const auto rows = run(""), exact = run(tolerance("1e-10"));
    double     error = 0;
    for (unsigned int k = 0; k < rows.size(); ++k)
      error = std::max(error,
                       std::abs(rows[k].at("Kinetic energy (J)") - exact[k].at("Kinetic energy (J)")) /
                         exact.back().at("Kinetic energy (J)"));
    out() << "2D, stiff stream that meets a block: kinetic energy "
          << (rows.size() == exact.size() && error < 1e-6 ? "to 1e-6" : "WRONG by " + std::to_string(error)) << std::endl;
  }

  void
  check_fallback(const MPI_Comm &comm)
  {
    const Row held = run_scene<2>(comm,
                                   pool<2>() + coupled +
                                     "subsection Linear solvers\n"
                                     "subsection Coupled\nset Maximum iterations = 1\nend\nend\n",
                                   1)
                        .back();
    const Row split =
      run_scene<2>(comm,
                   pool<2>() +
                     "subsection Viscosity\nset Pressure coupling = split with first projection\nend\n",
                   1)
        .back();
    out() << "2D, without iterations: fallbacks " << held.at("Fallbacks")
          << ", kinetic energy of the split to 1e-9: "
          << (std::abs(held.at("Kinetic energy (J)") / split.at("Kinetic energy (J)") - 1) < 1e-9)
          << std::endl;
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    const std::string name = std::to_string(dim) + "D, ";
    check_free_ball<dim>(comm);
    print(name + "pool",
          run_scene<dim>(comm, pool<dim>() + coupled, 1).back());
    print(name + "closed box",
          run_scene<dim>(comm,
                         steps(0.02, 2) + mesh(dim == 2 ? 4 : 3) +
                           "subsection Domain\nset Wall condition = no slip\nend\n"
                           "subsection Material\nset Density = 1\nset Viscosity = 0.5\nend\n"
                           "subsection Liquid 1\nset Shape = half space\nset Centre = " +
                           in_space<dim>("0.5, 10", ", 0.5") +
                           "set Normal = " + in_space<dim>("0, 1", ", 0") +
                           "end\nsubsection Solid 1\nset Radius = 0.2\nset Centre = " +
                           in_space<dim>("0.55, 0.5", ", 0.5") +
                           "set Centre of rotation = " + in_space<dim>("0.55, 0.5", ", 0.5") +
                           "set Angular velocity = " + (dim == 2 ? "1\n" : "0; 0; 1\n") + "end\n" + coupled +
                           tolerance("1e-12"),
                         1)
            .back());
    if constexpr (dim == 2)
      {
        check_fallback(comm);
        check_iterations(comm);
        check_stiff_stream(comm);
      }
  }
} // namespace

void
start(const int, char **)
{
  out().precision(4);
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
  });
}

const Test test("dynamics/stokes", start);
} // namespace tests::dynamics_stokes
