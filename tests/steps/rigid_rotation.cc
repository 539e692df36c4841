// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A free disc and sphere that rotate and move as a rigid body, viscosity 1e3
// (case A1): what the viscous step alone takes from momentum and energy, with
// each mapping. Only the face-fitted ones must take nothing. Argument: level.

#include "../tests.h"
#include "run_scene.h"

#include <treacle/steps/redistance.h>
#include <treacle/steps/remesh.h>
#include <treacle/io/measures.h>

using namespace tests;

template <int dim>
void
check(const MPI_Comm &comm, const std::string &mapping, const unsigned int level)
{
  const std::string text =
    "subsection Mesh\nset Surface level = " + std::to_string(level) +
    "\nset Interior level = 2\nset Air level = 2\nset Band width = 2\nend\n"
    "subsection Material\nset Viscosity = 1000\nend\n"
    "subsection Liquid 1\nset Radius = 0.3\nset Centre = " +
    (dim == 2 ? "0.503, 0.491\nset Velocity = 0.3 - (y - 0.491); 0.2 + (x - 0.503)" :
                "0.503, 0.491, 0.512\nset Velocity = 0.3 - (y - 0.491) + 0.5 * (z - 0.512); "
                "0.2 + (x - 0.503); -0.5 * (x - 0.503)") +
    "\nend\nsubsection Viscosity\nset Mapping = " + mapping + "\nend\n" + tolerance("1e-13") +
    "subsection Linear solvers\nsubsection Viscosity\nset Maximum iterations = 20000\nend\nend\n";
  typename Simulator<dim>::Parameters prm = parse<dim>(text, 0);
  const Scene<dim>                    scene(prm.scene);
  prm.mesh.lower_corner = scene.lower_corner();
  prm.mesh.upper_corner = scene.upper_corner();

  State<dim>       state(initial_mesh<dim>(comm, prm.mesh, scene));
  const Mesh<dim> &mesh = *state.mesh;
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    state.phi.local_element(node) = scene.liquid_distance(mesh.node_position[node]);
  state.phi.update_ghost_values();
  redistance(state, 6 * mesh.finest_size());
  for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
    state.u.local_element(f) = scene.initial_velocity(mesh.face_centre[f]) * mesh.face_normal[f];
  state.u.update_ghost_values();

  const LiquidDomain<dim> domain(state, scene, 0.01);
  const FaceFit<dim>      fit(prm.face_fit, domain);
  fit.solve(state.u, state.v);
  const Measures<dim> before = measure(state, domain);
  Viscosity<dim>(prm.viscosity).advance(state, fit, 0.01);
  const Measures<dim> after = measure(state, domain);

  double change = 0, size = 0;
  for (unsigned int k = 0; k < Motion<dim>::n_rotations; ++k)
    {
      change += std::pow(after.of_faces.angular[k] - before.of_faces.angular[k], 2);
      size += std::pow(before.of_faces.angular[k], 2);
    }
  const double angular = std::sqrt(change / size);
  const double energy =
    std::abs(after.of_faces.kinetic_energy / before.of_faces.kinetic_energy - 1);
  if (level > 5 && Utilities::MPI::this_mpi_process(comm) == 0) // for a person
    std::cout << dim << "D, " << mapping << ", " << mesh.cells->size()
              << " cells: angular momentum lost " << angular << ", kinetic energy " << energy
              << std::endl;
  const auto size_of = [](const double x) {
    return x < 1e-10 ? "below 1e-10" : x < 1e-2 ? "below 1e-2" : "below 1";
  };
  out() << dim << "D, " << mapping << ": angular momentum lost " << size_of(angular)
        << ", kinetic energy " << size_of(energy) << std::endl;
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int level = argc > 1 ? std::stoi(argv[1]) : 3;
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (const char *mapping :
         {"face fitted FLIP", "face fitted PIC", "face coupled", "node FLIP", "node PIC"})
      {
        check<2>(comm, mapping, level);
        check<3>(comm, mapping, level);
      }
  });
}
