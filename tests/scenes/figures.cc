// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The column and the drop of prm/figures, coarse and for a few steps, with every
// mapping: volume, centre of mass, energy and extent on 1, 2 and 3 ranks.

#include "../run_scene.h"
#include "../tests.h"

namespace tests::scenes_figures
{
template <int dim>
void
check(const MPI_Comm &comm, const std::string &liquid, const std::string &mapping)
{
  const auto rows = run_scene<dim>(comm,
                                   "set End time = 0.06\nset Frame interval = 0.06\n"
                                   "set Maximum time step = 0.01\nsubsection Mesh\nset Surface level = " +
                                     std::string(dim == 2 ? "5" : "4") +
                                     "\nset Interior level = 3\nset Air level = 2\nend\n"
                                     "subsection Material\nset Viscosity = 100\nend\n" +
                                     liquid + "subsection Viscosity\nset Pressure coupling = split with first projection\nset Mapping = " + mapping +
                                     "\nend\n" + tolerance("1e-10"));
  const Row        &last = rows.back();
  const std::string z    = dim == 2 ? "y" : "z";
  const std::string volume = "Liquid volume (m^" + std::to_string(dim) + ")";
  out().precision(5);
  out() << dim << "D, " << mapping << ": " << rows.size() - 1 << " steps, volume / first "
        << last.at(volume) / rows[1].at(volume) << ", centre of mass "
        << last.at("Centre of mass " + z + " (m)") << ", width "
        << last.at("Liquid maximum x (m)") - last.at("Liquid minimum x (m)")
        << ", kinetic energy / first "
        << last.at("Kinetic energy (J)") / rows[1].at("Kinetic energy (J)")
        << ", divergence " << (last.at("Maximum divergence (1/s)") < 1e-5 ? "small" : "LARGE")
        << std::endl;
}

void
start(const int, char **)
{
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const char *mapping : {"face fitted FLIP", "face fitted PIC", "node FLIP", "node PIC"})
      check<2>(comm,
               "subsection Liquid 1\nset Shape = box\nset Lower corner = 0.3, -0.2\n"
               "set Upper corner = 0.7, 0.7\nend\n",
               mapping);
    check<3>(comm,
             "subsection Liquid 1\nset Shape = sphere\nset Centre = 0.5, 0.5, 0.22\n"
             "set Radius = 0.18\nset Velocity = 0; 0; -1.2\nend\n",
             "face fitted FLIP");
  });
}

const Test test("scenes/figures", start);
} // namespace tests::scenes_figures
