// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The columns of the table, the values for a ball that turns and is strained,
// the same on 1, 2 and 3 ranks; and what is left of the table when a run is resumed; the energy of one that flies.

#include <treacle/dynamics/measures.h>
#include <treacle/io/statistics.h>

#include <sstream>

#include "../liquid.h"
#include "../tests.h"
#include "ball.h"

namespace tests::io_statistics
{
using namespace treacle;

void
show_file(const std::string &name, const bool with_rows)
{
  std::ifstream file(name);
  for (std::string line; std::getline(file, line);)
    if (line[0] == '#' && !with_rows)
      tests::out() << line << '\n';
    else if (line[0] != '#' && with_rows)
      {
        std::istringstream words(line);
        double             step, time;
        words >> step >> time;
        tests::out() << "row: step " << step << ", time " << time << '\n';
      }
  tests::out() << std::flush;
}

template <int dim>
void
check(const MPI_Comm &comm, const bool with_names)
{
  const bool        is_first = Utilities::MPI::this_mpi_process(comm) == 0;
  const Scene<dim>  scene(tests::ball_scene<dim>());
  State<dim>        state = tests::ball_state<dim>(comm);
  const std::string name  = "./statistics";
  StepInfo<dim>     info;
  info.dt                   = 0.25;
  info.dynamics.viscosity_iterations = 7;
  info.rebuilt              = true;

  Statistics<dim> statistics(comm, ".");
  for (unsigned int step = 0; step < 4; ++step, state.time += info.dt, ++state.step)
    statistics.add_row(state, tests::WhereLiquidIs<dim>(state, scene).domain, info);
  if (is_first && with_names)
    show_file(name, false);
  for (const char *axis : {" x", " y", " z"})
    if (dim == 3 || axis[1] < 'z')
      for (const char *column : {"Centre of mass",
                                 "Liquid minimum",
                                 "Liquid maximum",
                                 "Linear momentum",
                                 "Nodal linear momentum"})
        {
          const bool is_momentum =
            std::string(column).find("momentum") != std::string::npos;
          const std::string unit = is_momentum ? " (kg m/s)" : " (m)";
          const double      x    = statistics.last(column + std::string(axis) + unit);
          tests::out() << column << axis << ' ' << (std::abs(x) < 1e-10 ? 0 : x) << '\n';
        }
  for (const std::string &column :
       std::vector<std::string>{"Time step number",
                                "Cells",
                                dim == 2 ? "Liquid volume (m^2)" : "Liquid volume (m^3)",
                                "Volume drift",
                                "Potential energy (J)",
                                "Kinetic energy (J)",
                                "Nodal kinetic energy (J)",
                                dim == 2 ? "Angular momentum (kg m^2/s)" :
                                           "Angular momentum z (kg m^2/s)",
                                dim == 2 ? "Nodal angular momentum (kg m^2/s)" :
                                           "Nodal angular momentum z (kg m^2/s)",
                                "Viscous dissipation (W)",
                                "Maximum speed (m/s)",
                                "Rebuilds",
                                "Viscosity iterations"})
    tests::out() << column << ' ' << statistics.last(column) << '\n';

  // killed in the middle of a row, resumed after step 2
  if (is_first)
    std::ofstream(name, std::ios::app) << "  4 1.0";
  MPI_Barrier(comm);
  Statistics<dim> resumed(comm, ".");
  state.step = 2;
  resumed.resume(state, tests::WhereLiquidIs<dim>(state, scene).domain);
  state.phi.add(0.01);
  state.phi.update_ghost_values();
  state.time   = 10;
  state.step   = 3;
  info.rebuilt = false;
  resumed.add_row(state, tests::WhereLiquidIs<dim>(state, scene).domain, info);
  if (is_first)
    show_file(name, true);
  tests::out() << "drift " << resumed.last("Volume drift") << ", rebuilds "
               << resumed.last("Rebuilds") << '\n';

  // without liquid
  state.phi = 1.;
  state.phi.update_ghost_values();
  resumed.add_row(state, tests::WhereLiquidIs<dim>(state, scene).domain, info);
  tests::out() << "no liquid: " << resumed.last("Liquid minimum x (m)") << ' '
               << resumed.last("Kinetic energy (J)") << std::endl;
}

/// One that flies has M v^2 / 2 to rounding, however its surface cuts cells.
template <int dim>
void
fly(const MPI_Comm &comm)
{
  const Scene<dim>     scene(tests::ball_scene<dim>());
  State<dim>           state = tests::ball_state<dim>(comm);
  const Tensor<1, dim> v     = diagonal_point<dim>(3) + Point<dim>::unit_vector(0);
  for (LocalIndex f = 0; f < state.mesh->n_owned_faces(); ++f)
    state.u.local_element(f) = state.mesh->face_normal[f] * v;
  state.u.update_ghost_values();
  const tests::WhereLiquidIs<dim> liquid(state, scene);
  const Measures measures = measure(state, liquid.domain);
  const double   exact    = 0.5 * scene.density({}, 0) * measures.volume * v.norm_square();
  const double   error    = std::abs(measures.of_faces.kinetic_energy / exact - 1);
  tests::out() << dim << "D, flying: kinetic energy " << (error < 1e-12 ? "exact" : "OFF") << std::endl;
}

void
start(const int, char **)
{
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    const bool with_names = Utilities::MPI::n_mpi_processes(comm) == 1;
    check<2>(comm, with_names);
    check<3>(comm, with_names);
    fly<2>(comm);
    fly<3>(comm);
  });
}

const Test test("io/statistics", start);
} // namespace tests::io_statistics
