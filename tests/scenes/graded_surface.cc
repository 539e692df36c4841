// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The surface passes from leaves to others a quarter or an eighth as large, in every direction: liquid at rest stays
// at rest, a body that turns freely keeps its angular momentum and shape, waves pass, and leaves are as large as
// curvature, thickness, formula, walls, solids and velocity allow.

#include "../run_scene.h"
#include "../tests.h"

#include <treacle/transport/initial_mesh.h>

namespace tests::scenes_graded_surface
{
namespace
{
  /// Finest around a point of the surface, coarse around that.
  template <int dim>
  std::string
  graded(const std::string &x, const unsigned int coarsest, const unsigned int finest)
  {
    return "subsection Mesh\nset Surface level = " + std::to_string(finest) +
           "\nset Coarsest surface level = " + std::to_string(coarsest) +
           "\nset Leaves across = 0\nset Leaves per radius = 0\n"
           "set Interior level = 2\nset Air level = 2\nset Size = if(sqrt(" + x +
           ") < 0.15, 0.01, 1)\nend\n";
  }

  /// The surface between nodes, or on leaves of all sizes, where cells above it have dual centres below.
  template <int dim>
  void
  rest(const MPI_Comm &comm, const std::string &level, const std::string &viscosity)
  {
    const std::string y    = dim == 2 ? "y" : "z";
    const auto        rows = run_scene<dim>(
      comm,
      "set End time = " + std::string(dim == 2 ? "0.3" : "0.1") + "\nset Frame interval = 0.1\nset Maximum time step = 0.1\n"
      "subsection Domain\nset Wall condition = free slip\nend\n" +
        graded<dim>("(x - 0.5)^2 + (" + y + " - 0.4)^2", dim == 2 ? 3 : 2, dim == 2 ? 6 : 4) + tolerance("1e-13") +
        "subsection Material\nset Density = 1\nset Viscosity = " + viscosity + "\nend\n"
        "subsection Liquid 1\nset Shape = expression\nset Expression = " + y + " - " + level + "\nend\n");
    double fastest = 0;
    for (const Row &row : rows)
      fastest = std::max(fastest, row.at("Maximum speed (m/s)"));
    out() << dim << "D: at rest at " << level << ", viscosity " << viscosity << ": "
          << (fastest < 1e-8 * std::sqrt(9.81 * 0.4) ? "yes" : "no") << ", meshes "
          << rows.back().at("Rebuilds") << std::endl;
  }

  /// An eighth of a turn, in 3D half as far, past the fine leaves.
  template <int dim>
  void
  turn(const MPI_Comm &comm)
  {
    const std::string z       = dim == 2 ? "" : "; 0";
    const auto        text = [&](const std::string &mesh) {
      return "set End time = " + std::string(dim == 2 ? "0.8" : "0.4") + "\nset Frame interval = 0.4\nset Maximum time step = 0.1\n" + mesh +
             "subsection Gravity\nset Acceleration = 0; 0" + z +
             "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 10\nend\n"
             "subsection Liquid 1\nset Shape = box\nset Lower corner = 0.3, 0.35" + (dim == 2 ? "" : ", 0.4") +
             "\nset Upper corner = 0.7, 0.65" + (dim == 2 ? "" : ", 0.6") +
             "\nset Velocity = 0.5 - y; x - 0.5" + z + "\nend\n";
    };
    const auto        rows = run_scene<dim>(comm, text(graded<dim>("(x - 0.7)^2 + (y - 0.5)^2", dim == 2 ? 4 : 3, dim == 2 ? 6 : 4)));
    const std::string l = std::string("Nodal angular momentum ") + (dim == 2 ? "(kg m^2/s)" : "z (kg m^2/s)");
    out() << std::setprecision(2) << dim << "D: turns, angular momentum "
          << rows.back().at(l) / rows.front().at(l) - 1 << ", kinetic energy "
          << rows.back().at("Nodal kinetic energy (J)") / rows.front().at("Nodal kinetic energy (J)") - 1 << ", width "
          << rows.back().at("Liquid maximum x (m)") - rows.back().at("Liquid minimum x (m)")
          << std::setprecision(6) << ", cells " << rows.front().at("Cells") << std::endl;
  }

  /// Of a mesh at t = 0: leaves of each level that hold liquid or surround it.
  template <int dim>
  void
  levels(const MPI_Comm &comm, const std::string &name, const std::string &text, const unsigned int n_solids)
  {
    const auto       prm = parse<dim>(text, n_solids);
    const Scene<dim> scene(prm.scene, comm);
    const auto                       mesh   = initial_mesh<dim>(comm, prm.mesh, scene);
    const Octree<dim>               &octree = mesh->octree();
    std::vector<unsigned int>        count(prm.mesh.surface_level + 1);
    for (unsigned int l = 0; l < octree.n_owned_leaves(); ++l)
      ++count[octree.leaves()[l].level];
    Utilities::MPI::sum(count, comm, count);
    out() << dim << "D, " << name << ": leaves by level";
    for (const unsigned int n : count)
      out() << ' ' << n;
    out() << std::endl;
  }

  template <int dim>
  void
  sizes(const MPI_Comm &comm)
  {
    const std::string mesh = "subsection Mesh\nset Surface level = " + std::string(dim == 2 ? "6" : "4") +
                             "\nset Coarsest surface level = " + (dim == 2 ? "3" : "2") + "\n"
                             "set Interior level = 2\nset Air level = 2\n";
    const std::string y = dim == 2 ? "y" : "z", all = dim == 2 ? "" : ", 0.5";
    const auto        box = [](const double half) {
      return "subsection Liquid 1\nset Shape = box\nset Lower corner = -1, " + std::string(dim == 2 ? "" : "-1, ") +
             std::to_string(0.5 - half) + "\nset Upper corner = 2, " + (dim == 2 ? "" : "2, ") +
             std::to_string(0.5 + half) + "\nend\n";
    };
    levels<dim>(comm, "thick layer", mesh + "end\n" + box(0.3), 0);
    levels<dim>(comm, "thin layer", mesh + "end\n" + box(0.06), 0);
    levels<dim>(comm,
                "sheet between coarse leaves",
                mesh + "end\nsubsection Liquid 1\nset Shape = box\nset Lower corner = 0.3, " +
                  (dim == 2 ? "" : "0.3, ") + "0.5\nset Upper corner = 0.7, " + (dim == 2 ? "" : "0.7, ") +
                  (dim == 2 ? "0.53" : "0.6") + "\nend\n",
                0);
    levels<dim>(comm,
                "drop",
                mesh + "end\nsubsection Liquid 1\nset Centre = 0.5, 0.5" + all + "\nset Radius = 0.1\nend\n",
                0);
    levels<dim>(comm,
                "drop in few cells",
                mesh + "set Maximum cells = " + (dim == 2 ? "1200" : "8000") +
                  "\nend\nsubsection Liquid 1\nset Centre = 0.5, 0.5" + all + "\nset Radius = 0.1\nend\n",
                0);
    const std::string drops = "end\nsubsection Liquid 1\nset Shape = expression\nset Expression = min(sqrt((x - 0.4)^2 + (" + y +
                              " - 0.4)^2) - 0.3, sqrt((x - 0.82)^2 + (" + y + " - 0.82)^2) - 0.03)\nend\n";
    levels<dim>(comm, "large and small drop", mesh + drops, 0);
    levels<dim>(comm, "the same in few cells", mesh + "set Maximum cells = " + (dim == 2 ? "1100" : "20000") + "\n" + drops, 0);
    const std::string full = "subsection Liquid 1\nset Shape = expression\nset Expression = -1\nend\n";
    levels<dim>(comm,
                "solid and walls",
                mesh + "end\nsubsection Domain\nset Wall condition = default: free slip; left: no slip\n"
                       "set Wall level = 4\nend\nsubsection Solid 1\nset Centre = 0.6, 0.5" + all +
                  "\nset Radius = 0.1\nset Level = 5\nend\n" + full,
                1);
    levels<dim>(comm, "formula", mesh + "set Size = 0.05 + 0.4*x\nend\n" + full, 0);
    const std::string jumps = mesh + "set Fine at jumps = true\nend\n" + full;
    levels<dim>(comm, "jump", jumps + "subsection Material\nset Viscosity = if(x < 0.52, 1, 3)\nend\n", 0);
    levels<dim>(comm, "no jump", jumps + "subsection Material\nset Viscosity = 1 + x\nend\n", 0);
  }

  /// A ball moves through a full box; its drag beside that with fine leaves everywhere.
  template <int dim>
  void
  drag(const MPI_Comm &comm)
  {
    const std::string z   = dim == 2 ? "" : "; 0";
    const auto        run = [&](const std::string &mesh) {
      return run_scene<dim>(comm,
                            "set End time = 0.004\nset Frame interval = 0.004\nset Maximum time step = 0.001\n"
                            "subsection Gravity\nset Acceleration = 0; 0" + z +
                              "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 1000\nend\n"
                              "subsection Liquid 1\nset Shape = expression\nset Expression = -1\nend\n"
                              "subsection Solid 1\nset Shape = sphere\nset Radius = " +
                              (dim == 2 ? "0.1" : "0.2") + "\nset Velocity = 1; 0" + z +
                              "\nend\nsubsection Mesh\nset Air level = 1\nset Surface level = " +
                              std::to_string(dim == 2 ? 5 : 3) + "\n" + mesh + "end\n",
                            1);
    };
    const auto fine   = run("set Interior level = " + std::to_string(dim == 2 ? 5 : 3) + "\n"),
               asked  = run("set Interior level = 1\nset Velocity error = 0.1\n"),
               coarse = run("set Interior level = 1\n");
    const auto error  = [&](const std::vector<Row> &rows) {
      const std::string force = "Solid 1 force x (N)";
      return std::abs(rows.back().at(force) / fine.back().at(force) - 1);
    };
    out() << dim << "D: drag, cells " << fine.back().at("Cells") << ", by velocity " << asked.front().at("Cells")
          << " to " << asked.back().at("Cells") << ", force "
          << (error(asked) < 0.002 ? "within 0.2 %" : "OFF") << ", without " << (error(coarse) < 0.002 ? "TOO" : "not")
          << std::endl;
  }

  /// Heavy liquid sinks into a light one, in a full box; kinetic energy beside that with fine leaves everywhere.
  void
  overturn(const MPI_Comm &comm)
  {
    const auto run = [&](const std::string &mesh) {
      const std::string wave = "subsection Liquid 1\nset Shape = expression\nset Expression = ",
                        text = "set End time = 0.8\nset Frame interval = 0.8\nset Maximum time step = 0.05\n"
                               "subsection Material\nset Transport = advected\nset Viscosity = 10\nend\n" +
                               wave + "y - 0.5 - 0.05*cos(2*pi*x)\nset Density = 900\nend\n" +
                               "subsection Liquid 2\nset Shape = expression\nset Expression = "
                               "0.5 + 0.05*cos(2*pi*x) - y\nend\nsubsection Mesh\nset Surface level = 5\n" +
                               mesh + "end\n";
      return run_scene<2>(comm, text, 0, 2);
    };
    const auto fine = run("set Interior level = 5\n"), jumps = run("set Interior level = 3\nset Fine at jumps = true\n"),
               coarse = run("set Interior level = 3\n");
    const auto error  = [&](const std::vector<Row> &rows) {
      const std::string energy = "Nodal kinetic energy (J)";
      return std::abs(rows.back().at(energy) / fine.back().at(energy) - 1);
    };
    out() << "2D: overturns, cells " << fine.back().at("Cells") << ", fine at jumps " << jumps.front().at("Cells")
          << " to " << jumps.back().at("Cells") << " in " << jumps.back().at("Rebuilds") << " meshes and "
          << jumps.size() - 1 << " steps, kinetic energy "
          << (error(jumps) < 0.05 ? "within 5 %" : "OFF") << ", without " << (error(coarse) < 0.05 ? "TOO" : "not")
          << std::endl;
  }

  /// A millionth of a metre of wave on a pool, past leaves that become four times as large: as fast in the last half second as in the first.
  void
  tremble(const MPI_Comm &comm)
  {
    const auto rows = run_scene<2>(comm,
                                   "set End time = 2\nset Frame interval = 2\nset Maximum time step = 0.1\nset Maximum CFL number = 2\n"
                                   "subsection Domain\nset Lower corner = -1, 0\nset Upper corner = 1, 1\n"
                                   "set Wall condition = free slip\nend\n"
                                   "subsection Mesh\nset Surface level = 5\nset Coarsest surface level = 3\n"
                                   "set Interior level = 3\nset Air level = 2\nset Leaves across = 0\n"
                                   "set Leaves per radius = 0\nset Size = if(x < 0, 0.03, 1)\nend\n"
                                   "subsection Material\nset Density = 1\nset Viscosity = 0\nend\n"
                                   "subsection Liquid 1\nset Shape = expression\n"
                                   "set Expression = y - 0.53 - 1e-6*cos(pi/2*x)\nend\n");
    double first = 0, last = 0;
    for (const Row &row : rows)
      for (const auto &[speed, is_there] : {std::pair(&first, row.at("Time (s)") < 0.5), {&last, row.at("Time (s)") > 1.5}})
        if (is_there)
          *speed = std::max(*speed, row.at("Maximum speed (m/s)"));
    out() << "2D: tiny waves at a jump, steps " << rows.size() - 1 << ": " << (last < 2 * first ? "stay" : "GROW") << std::endl;
  }

  /// A packet of waves comes to where leaves become four times as large, 32 of these a wave; what a probe before that
  /// sees come back, beside the same with fine leaves all along.
  void
  wave(const MPI_Comm &comm)
  {
    const std::string along = "cos(pi/2*(x + 6))*exp(-((x + 6)/2)^2)", up = "sin(pi/2*(x + 6))*exp(-((x + 6)/2)^2)",
                      speed = "0.005*sqrt(9.81*pi/2*tanh(pi/4))/sinh(pi/4)";
    const auto        run   = [&](const std::string &mesh) {
      return run_scene<2>(comm,
                          "set End time = 6\nset Frame interval = 6\nset Maximum time step = 0.1\nset Maximum CFL number = 6\n"
                          "subsection Domain\nset Lower corner = -11, 0\nset Upper corner = 6, 1\n"
                          "set Wall condition = free slip\nend\n"
                          "subsection Mesh\nset Surface level = 5\nset Leaves across = 0\nset Leaves per radius = 0\n"
                          "set Air level = 2\n" + mesh +
                          "end\nsubsection Material\nset Density = 1\nset Viscosity = 0\nend\n"
                          "subsection Liquid 1\nset Shape = expression\nset Expression = y - 0.5 - 0.005*" + along +
                          "\nset Velocity = " + speed + "*cosh(pi/2*y)*" + along + "; " + speed + "*sinh(pi/2*y)*" + up +
                          "\nend\nsubsection Probe 1\nset Position = -3, 0.25\nend\n",
                          0, 1, 0, 1);
    };
    const auto fine   = run("set Interior level = 5\n"),
               graded = run("set Interior level = 3\nset Coarsest surface level = 3\nset Size = if(x < 0, 0.03, 1)\n");
    double passes = 0, returns = 0;
    for (unsigned int n = 0; n < std::min(fine.size(), graded.size()); ++n)
      {
        const std::string u = "Probe 1 velocity x (m/s)";
        passes  = std::max(passes, std::abs(fine[n].at(u)));
        returns = std::max(returns, std::abs(graded[n].at(u) - fine[n].at(u)));
      }
    out() << "2D: wave across a jump, steps " << graded.size() - 1 << ", comes back " << std::setprecision(1)
          << 100 * returns / passes << " %" << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    out() << std::setprecision(3);
    for (const auto &[level, viscosity] : {std::pair("0.4", "0.1"), {"0.375", "0.1"}, {"0.375", "0"}})
      {
        rest<2>(comm, level, viscosity);
        rest<3>(comm, level, viscosity);
      }
    turn<2>(comm);
    turn<3>(comm);
    sizes<2>(comm);
    sizes<3>(comm);
    drag<2>(comm);
    overturn(comm);
    tremble(comm);
  });
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    wave(MPI_COMM_SELF);
  wait_for_all();
}

const Test test("scenes/graded_surface", start);
} // namespace tests::scenes_graded_surface
