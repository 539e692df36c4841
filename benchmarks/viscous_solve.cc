// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Iterations and seconds of one viscous step on a body in flight, for each mapping and
// preconditioner, over dt mu / (rho h^2) with h the finest leaf edge.
//
//   viscous_solve DIMENSION LEVEL [MAPPING [STRESS MODEL]]

#include <treacle/base/timing.h>
#include <treacle/simulator.h>
#include <treacle/surface/redistance.h>
#include <treacle/transport/initial_mesh.h>

#include <cstdio>

using namespace treacle;

namespace
{
  template <int dim>
  typename Simulator<dim>::Parameters
  parameters(const std::string &level,
             const std::string &mapping,
             const std::string &stress_model,
             const std::string &preconditioner)
  {
    const std::string liquid =
      dim == 2 ? "set Expression = sqrt((x-0.503)^2 + (y-0.491)^2) - 0.2 - 0.02*sin(20*x)*sin(20*y)\n"
                 "set Velocity = sin(9*y) + 0.3*sin(40*x); cos(7*x)\n" :
                 "set Expression = sqrt((x-0.503)^2 + (y-0.491)^2 + (z-0.512)^2) - 0.2"
                 " - 0.02*sin(20*x)*sin(20*y)*sin(20*z)\n"
                 "set Velocity = sin(9*y) + 0.3*sin(40*x); cos(7*z); sin(8*x)\n";
    ParameterHandler                    prm;
    typename Simulator<dim>::Parameters result;
    result.add_parameters(prm, 1, 0);
    prm.parse_input_from_string(
      "subsection Mesh\nset Surface level = " + level +
      "\nset Interior level = 4\nset Air level = 2\nset Band width = 2\nend\n"
      "subsection Liquid 1\nset Shape = expression\n" + liquid +
      "end\nsubsection Viscosity\nset Mapping = " + mapping + "\nset Stress model = " +
      stress_model + "\nend\nsubsection Linear solvers\nsubsection Viscosity\n"
      "set Preconditioner = " + preconditioner +
      "\nset Maximum iterations = 20000\nend\nend\n");
    return result;
  }

  /// Seconds and iterations; -1 where it does not converge.
  template <int dim>
  void
  print(const State<dim>                          &start,
        const FaceFit<dim>                        &fit,
        const typename Viscosity<dim>::Parameters &prm,
        const std::string                         &choices,
        const double                               ratio)
  {
    const Mesh<dim> &mesh = *start.mesh;
    State<dim>       state(start);
    state.u.update_ghost_values();
    const double h = mesh.finest_size(), dt = ratio * 1000 * h * h / 150;
    int          iterations = -1;
    Timer        timer(mesh.communicator(), true);
    try
      {
        iterations = Viscosity<dim>(prm).advance(state, fit, dt);
      }
    catch (const UserError &)
      {}
    timer.stop();
    const double seconds = timer.wall_time();
    if (Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      std::printf("%dD %9llu cells  %-36s  dt mu/(rho h^2) = %-6g %5d iterations %8.2f s\n",
                  dim,
                  static_cast<unsigned long long>(mesh.cells->size()),
                  choices.c_str(),
                  ratio,
                  iterations,
                  seconds),
        std::fflush(stdout);
  }

  template <int dim>
  void
  run(const std::string &level, const std::string &mapping, const std::string &stress_model)
  {
    typename Simulator<dim>::Parameters prm = parameters<dim>(level, mapping, stress_model, "amg");
    const Scene<dim>                    scene(prm.scene);
    prm.mesh.lower_corner = scene.lower_corner();
    prm.mesh.upper_corner = scene.upper_corner();

    State<dim>       state(initial_mesh<dim>(MPI_COMM_WORLD, prm.mesh, scene));
    const Mesh<dim> &mesh = *state.mesh;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      state.phi.local_element(node) = scene.liquid_distance(mesh.node_position[node]);
    state.phi.update_ghost_values();
    redistance(state, 6 * mesh.finest_size());
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      state.u.local_element(f) = scene.initial_velocity(mesh.face_centre(f)) * mesh.face_normal[f];
    state.u.update_ghost_values();
    const MeshData<dim>     data(mesh, scene);
    const LiquidDomain<dim> domain(prm.liquid_domain, state, data);
    const FaceFit<dim>      fit(prm.dynamics.face_fit, domain);

    for (const std::string preconditioner : {"amg", "jacobi"})
      {
        const auto choices =
          parameters<dim>(level, mapping, stress_model, preconditioner).dynamics.viscosity;
        for (const double ratio : {1., 1e2, 1e4})
          print(state, fit, choices, mapping + ", " + stress_model + ", " + preconditioner, ratio);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                mapping      = argc > 3 ? argv[3] : "face coupled";
  const std::string                stress_model = argc > 4 ? argv[4] : "full";
  if (argc > 2 && std::string(argv[1]) == "2")
    run<2>(argv[2], mapping, stress_model);
  else if (argc > 2)
    run<3>(argv[2], mapping, stress_model);
}
