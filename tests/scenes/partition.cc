// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A thin ring and an emitter, both askew, do on several ranks what they do on one, but for rounding: markers of edges that
// reach out of a rank's cells, and those that an emitter draws over to another rank. So does a pool in a drum about a solid that
// swings: where the air's velocity comes from, and what a blow has ended, is not for roundoff to tell. And liquids of different density and viscosity that meet.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_partition
{
namespace
{
  template <int dim>
  std::string
  scene(const std::string &body)
  {
    const std::string end = dim == 2 ? "0.12" : "0.05";
    return "set End time = " + end + "\nset Frame interval = " + end +
           "\nset Maximum time step = 0.0125\nsubsection Mesh\nset Surface level = " +
           (dim == 2 ? "4\nset Interior level = 4" : "3\nset Interior level = 2") +
           "\nset Air level = 2\nend\nsubsection Material\nset Density = 900\nset Viscosity = 2e4\nend\nsubsection Gravity\n"
           "set Acceleration = 0; " + (dim == 3 ? "0; " : "") + "-9.81\nend\n" + body;
  }

  /// The largest difference between what liquid has and does on all of @p comm and on one rank, relative. Known to the first rank. Collective.
  template <int dim>
  double
  difference(const MPI_Comm    &comm,
             const std::string &text,
             const unsigned int n_solids,
             const unsigned int n_liquids,
             const unsigned int n_emitters)
  {
    const auto together = run_scene<dim>(comm, text, n_solids, n_liquids, n_emitters);
    double     most     = 0;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        const auto alone = run_scene<dim>(MPI_COMM_SELF, text, n_solids, n_liquids, n_emitters);
        for (const std::string name : {dim == 2 ? "Liquid volume (m^2)" : "Liquid volume (m^3)",
                                       "Centre of mass x (m)",
                                       "Kinetic energy (J)",
                                       "Potential energy (J)"})
          for (std::size_t k = 0; k < alone.size(); ++k)
            {
              const double a = together.at(k).at(name), b = alone[k].at(name), error = a == b ? 0. : std::abs(a / b - 1);
              most = std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(most, error);
            }
      }
    MPI_Barrier(comm);
    return most;
  }

  std::string
  verdict(const double most)
  {
    return most < 1e-6 ? "the same" : "OFF BY " + std::to_string(most);
  }

  void
  check_drum(const MPI_Comm &comm)
  {
    const double most = difference<2>(comm,
                                      "set End time = 0.5\nset Frame interval = 0.1\nset Maximum time step = 0.05\n"
                                      "subsection Mesh\nset Surface level = 5\nset Interior level = 4\nset Air level = 2\nend\n"
                                      "subsection Material\nset Density = 15.52\nset Viscosity = 0.04371\nend\n"
                                      "subsection Gravity\nset Acceleration = 0; -9.81\nend\n"
                                      "subsection Liquid 1\nset Shape = half space\nset Centre = 0, 0.4388524088\nset Normal = 0, 1\nend\n"
                                      "subsection Liquid 2\nset Shape = box\nset Lower corner = -1, -1\n"
                                      "set Upper corner = 0.228112048, 0.4435744838\nend\n"
                                      "subsection Solid 1\nset Shape = sphere\nset Invert = true\nset Centre = 0.5, 0.5\nset Radius = 0.48\n"
                                      "set Centre of rotation = 0.5, 0.5\nset Angular velocity = 3.563\nend\n"
                                      "subsection Solid 2\nset Shape = capsule\nset Start = 0.4983587251, 0.220118781\n"
                                      "set End = 0.6717988703, 0.442849496\nset Radius = 0.0575\n"
                                      "set Displacement = 0.08158 * sin(12.83 * t); 0\nend\n",
                                      2,
                                      2,
                                      0);
    out() << "2D: drum " << verdict(most) << std::endl;
  }

  /// A heavy stiff ball sinks in a pool, into which light liquid is poured.
  template <int dim>
  void
  check_liquids(const MPI_Comm &comm)
  {
    const std::string z    = dim == 2 ? ", " : ", 0.5, ", up = dim == 2 ? "0, 1" : "0, 0, 1", down = dim == 2 ? "0; -1" : "0; 0; -1";
    const double      most = difference<dim>(comm,
                                        std::string("set End time = 0.3\nset Frame interval = 0.1\nsubsection Mesh\nset Surface level = ") +
                                          (dim == 2 ? "5" : "3\nset Interior level = 2\nset Air level = 2") + "\nend\n" +
                                          "subsection Material\nset Density = 1000\nset Viscosity = 5\nset Transport = advected\nend\n" +
                                          "subsection Liquid 1\nset Shape = half space\nset Centre = 0.5" + z + "0.356\nset Normal = " + up +
                                          "\nend\nsubsection Liquid 2\nset Radius = 0.13\nset Centre = 0.464" + z +
                                          "0.55\nset Density = 2500\nset Viscosity = 100\nend\n" +
                                          "subsection Emitter 1\nset Radius = 0.1\nset Centre = 0.712" + z + "0.8\nset Velocity = " + down +
                                          "\nset Density = 500\nset Viscosity = 1\nend\n",
                                        0,
                                        2,
                                        1);
    out() << dim << "D: three liquids " << verdict(most) << std::endl;
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    const std::string ring =
      dim == 2 ? "subsection Liquid 1\nset Shape = torus\nset Centre = 0.47, 0.52\nset Radius = 0.25\nset Minor radius = 0.05\n"
                 "set Velocity = 1; 0\nend\n" :
                 "subsection Liquid 1\nset Shape = torus\nset Centre = 0.304, 0.32, 0.516\nset Radius = 0.247\n"
                 "set Minor radius = 0.0988\nset Axis = 0.707, -0.1138, 0.8362\nset Velocity = 1; 0; 0\nend\n";
    const std::string emitter =
      "subsection Emitter 1\nset Shape = cylinder\nset Radius = " +
      std::string(dim == 2 ? "0.07\nset Length = 0.14\nset Centre = 0.63, 0.7\nset Axis = 0.5, 1\nset Velocity = -0.66; -1.49" :
                             "0.119\nset Length = 0.238\nset Centre = 0.467, 0.5, 0.7\nset Axis = 0.5, 0, 1\n"
                             "set Velocity = -0.73; 0; -1.63") +
      "\nend\n";
    const double of_ring    = difference<dim>(comm, scene<dim>(ring), 0, 1, 0),
                 of_emitter = difference<dim>(comm, scene<dim>(emitter), 0, 0, 1);
    out() << dim << "D: thin ring " << verdict(of_ring) << ", emitter " << verdict(of_emitter) << std::endl;
  }

  void
  start(const int, char **)
  {
    on_1_2_3_ranks([](const MPI_Comm &comm) {
      check<2>(comm);
      check<3>(comm);
      check_drum(comm);
      check_liquids<2>(comm);
      check_liquids<3>(comm);
    });
  }

  const Test test("scenes/partition", start);
} // namespace
} // namespace tests::scenes_partition
