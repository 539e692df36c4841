// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Exact cases on meshes from files, 1, 2 and 3 ranks: water at rest in an oblique
// container, or a body-centred box, stays at rest where no dual length is clamped (and nearly so where some
// are: a jittered box is the worst mesh there is); the viscous step takes nothing from a rigid motion; a drop in free fall; one that lands on a
// floor (case C9d) is held by it, though between the two there may be air thinner than the cells.
// Argument: cells along an edge.

#include "../mesh_files.h"
#include "../tests.h"
#include "../body.h"

namespace tests::scenes_imported
{
std::string
mesh_from(const std::string &path)
{
  return "subsection Mesh\nset Type = file\nset File = " + path + "\nend\n";
}

template <int dim>
std::string
write_mesh(const MPI_Comm &comm, const unsigned int n, const bool squeezed)
{
  const std::string path = (squeezed ? "squeezed" : "jittered") + std::to_string(dim) + ".msh";
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    write_box<dim>(path, n, squeezed, squeezed ? 0. : 0.15);
  return mesh_from(path);
}

void
say(const MPI_Comm &comm, const std::string &text)
{
  if (Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << text << std::endl;
}

template <int dim>
void
check_rest(const MPI_Comm &comm, const std::string &name, const double height, const std::string &mesh)
{
  const auto rows =
    run_scene<dim>(comm,
                   "set End time = 0.05\nset Frame interval = 10\nset Maximum time step = 0.01\n"
                   "subsection Liquid 1\nset Shape = half space\nset Centre = " +
                     std::string(dim == 2 ? "0, " : "0, 0, ") + std::to_string(height) +
                     "\nset Normal = " + (dim == 2 ? "0, 1" : "0, 0, 1") + "\nend\n" + mesh +
                     tolerance("1e-13"));
  const double speed = rows.back().at("Maximum speed (m/s)") / std::sqrt(9.81 * 0.5);
  std::ostringstream text;
  text << dim << "D at rest, " << name << ": speed " << speed
       << " sqrt(g h)";
  say(comm, text.str());
  out().precision(3);
  out() << dim << "D at rest, " << name << ": speed ";
  if (speed < 1e-12)
    out() << "below 1e-12";
  else
    out() << speed;
  out() << " sqrt(g h)" << std::endl;
}

template <int dim>
void
check_fall(const MPI_Comm &comm, const unsigned int n)
{
  const std::string mesh = write_mesh<dim>(comm, n, false);
  const auto        rows = run_scene<dim>(
    comm,
    "set End time = 0.1\nset Frame interval = 10\nset Maximum time step = 0.01\n"
           "subsection Surface tracking\nset Volume correction = false\nend\n"
           "subsection Liquid 1\nset Centre = " +
      std::string(dim == 2 ? "0.5, 0.6" : "0.5, 0.5, 0.6") + "\nset Radius = 0.23\nend\n" + mesh +
      tolerance("1e-12"));
  const std::string z      = std::string("Centre of mass ") + (dim == 2 ? "y" : "z") + " (m)";
  const std::string volume = "Liquid volume (m^" + std::to_string(dim) + ")";
  const double      fallen = rows.front().at(z) - rows.back().at(z);
  out().precision(4);
  out() << dim << "D free fall: " << rows.size() - 1 << " steps, fallen / (g t^2 / 2) "
        << fallen / (9.81 * 0.1 * 0.1 / 2) << ", volume / first "
        << rows.back().at(volume) / rows.front().at(volume) << std::endl;
}

/// In units of 0.8 m, from just above the floor on.
void
check_landing(const MPI_Comm &comm, const unsigned int n)
{
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    write_rows("rows.msh", n);
  const auto rows =
    run_scene<2>(comm,
                 "set End time = 1.4036\nset Frame interval = 10\nset Maximum time step = " + std::to_string(0.32 / n) +
                   "\nsubsection Domain\nset Wall condition = default: free slip; bottom: no slip\nend\n"
                   "subsection Material\nset Density = 1\nset Viscosity = 0.16\nend\n"
                   "subsection Gravity\nset Acceleration = 0; -0.24473\nend\n"
                   "subsection Liquid 1\nset Centre = 0, 0.48\nset Radius = 0.4\nset Velocity = 0; -1.24385\nend\n" +
                   mesh_from("rows.msh"));
  const double       off = rows.back().at("Liquid maximum x (m)") / (0.4 * 1.7138) - 1;
  std::ostringstream text;
  text << "landing: width " << 100 * off << " %";
  say(comm, text.str());
  out() << "2D landing: " << rows.size() - 1 << " steps, width " << (std::abs(off) < 5e-3 ? "within 0.5 %" : "OFF") << std::endl;
}

template <int dim>
void
check_rotation(const MPI_Comm &comm, const unsigned int n, const std::string &mapping)
{
  Body<dim>  body(comm, write_mesh<dim>(comm, n, false) + rigid_rotation<dim>(mapping));
  const Loss loss = lost_by_viscosity(body);
  print(body, mapping, loss);
  out() << dim << "D rotation, " << mapping << ": "
        << (loss.angular_momentum < 1e-10 && loss.kinetic_energy < 1e-10 ? "kept" : "LOST") << std::endl;
}

void
start(const int argc, char **argv)
{
  const unsigned int n = argc > 1 ? std::stoi(argv[1]) : 0;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    const unsigned int n2 = n ? n : 16, n3 = n ? n : 6;
    check_rest<2>(comm, "squeezed", 0.231, write_mesh<2>(comm, n2, true));
    check_rest<3>(comm, "squeezed", 0.231, write_mesh<3>(comm, n3, true));
    check_rest<2>(comm, "jittered", 0.531, write_mesh<2>(comm, n2, false));
    check_rest<3>(comm, "jittered", 0.531, write_mesh<3>(comm, n3, false));
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      write_body_centred("body_centred.msh", n3);
    check_rest<3>(comm, "body-centred", 0.531, mesh_from("body_centred.msh"));
    check_fall<2>(comm, n2);
    check_fall<3>(comm, 2 * n3);
    check_landing(comm, 2 * n2);
    for (const char *mapping : {"face fitted FLIP", "face fitted PIC"})
      {
        check_rotation<2>(comm, n2, mapping);
        check_rotation<3>(comm, n3, mapping);
      }
  });
}

const Test test("scenes/imported", start);
} // namespace tests::scenes_imported
