// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A ball of two halves, one light and thin, one heavy and thick, turns about its centre, rigidly and many
// times: the jump stays within a part of a leaf of where it belongs, and neither half grows, on 1, 2
// and 3 ranks. Argument: level, steps a turn, turns.

#include "../liquid.h"
#include "../run_scene.h"
#include "../tests.h"

#include <treacle/fields/moved_points.h>
#include <treacle/surface/carried_material.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/initial_mesh.h>

namespace tests::transport_material_points
{
template <int dim>
void
turn(const MPI_Comm    &comm,
     const unsigned int level,
     const unsigned int n_steps,
     const unsigned int n_turns)
{
  const std::string centre = dim == 2 ? "0.5, 0.5" : "0.5, 0.5, 0.5", l = std::to_string(level);
  const std::string shape  = "set Shape = expression\nset Expression = max(sqrt((x-0.5)^2 + (y-0.5)^2" +
                            std::string(dim == 2 ? "" : "+ (z-0.5)^2") + ") - 0.4, ";
  const auto prm = parse<dim>("subsection Mesh\nset Surface level = " + l + "\nset Interior level = " + l +
                                "\nset Air level = 2\nend\nsubsection Material\nset Transport = advected\nend\n"
                                "subsection Liquid 1\n" + shape + "x - 0.5)\nset Viscosity = 1\n"
                                "set Density = 500\nend\nsubsection Liquid 2\n" + shape +
                                "0.5 - x)\nset Viscosity = 100\nset Density = 1000\nend\n",
                              0,
                              2);
  const Scene<dim>                 scene(prm.scene);
  typename Octree<dim>::Parameters mesh_prm = prm.mesh;
  mesh_prm.lower_corner                     = scene.lower_corner();
  mesh_prm.upper_corner                     = scene.upper_corner();
  const auto          mesh = initial_mesh<dim>(comm, mesh_prm, scene);
  const MeshData<dim> data(*mesh, scene);
  auto                state = std::make_unique<State<dim>>(mesh);
  for (LocalIndex node = 0; node < mesh->n_owned_nodes(); ++node)
    {
      const Tensor<1, dim> r = mesh->node_position[node] - mesh->middle();
      state->phi.local_element(node) = r.norm() - 0.4;
    }
  state->phi.update_ghost_values();
  set_initial_material(*state, data);
  settle_material(*state, data, 6);

  double       angle = 0;
  const double h = mesh->finest_size();
  for (unsigned int step = 0; step <= n_steps * n_turns; ++step)
    {
      const WhereLiquidIs<dim> liquid(*state, scene);
      if (step % (n_steps * n_turns) == 0)
        {
          double wrong = 0, total = 0;
          for (LocalIndex c = 0; c < mesh->n_owned_cells(); ++c)
            if (const double volume = liquid.domain.liquid_volume[c]; volume > 0)
              {
                const Tensor<1, dim> r       = liquid.domain.liquid_centre[c] - mesh->middle();
                const double         is_left = r[0] * std::cos(angle) + r[1] * std::sin(angle) < 0;
                const double         share   = (1000 - liquid.domain.density[c]) / 500;
                wrong += volume * std::abs(share - is_left);
                total += volume * (1 - share);
              }
          wrong              = Utilities::MPI::sum(wrong, comm);
          const double width = wrong / (dim == 2 ? 0.8 : numbers::PI * 0.16) / h;
          const double share = Utilities::MPI::sum(total, comm) / liquid.domain.total_volume();
          out() << dim << "D after " << step << " steps: error times jump's area is " << std::setprecision(2)
                << width << " leaves, " << (std::abs(share - 0.5) < 0.01 ? "half" : "NOT HALF")
                << " is thick" << std::endl;
        }
      for (LocalIndex node = 0; node < mesh->n_owned_nodes(); ++node)
        {
          const Tensor<1, dim> r = mesh->node_position[node] - mesh->middle();
          Tensor<1, dim>       v;
          v[0] = -2 * numbers::PI * r[1];
          v[1] = 2 * numbers::PI * r[0];
          state->v.set(node, v);
        }
      state->v.update_ghost_values();
      const SurfaceGeometry<dim> surface(mesh, state->phi);
      const Advection<dim>       advection(prm.transport.advection,
                                     *state,
                                     liquid.domain,
                                     surface,
                                     BackwardDifference(1. / n_steps, *state));
      auto next = std::make_unique<State<dim>>(
        advection.advance(mesh, 0.3, Advection<dim>::SurfaceMotion::none));
      settle_material(*next, data, 6);
      state = std::move(next);
      angle += 2 * numbers::PI / n_steps;
    }
}

void
start(const int argc, char **argv)
{
  const auto argument = [&](const int k, const unsigned int otherwise) {
    return argc > k ? std::stoi(argv[k]) : otherwise;
  };
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    turn<2>(comm, argument(1, 5), argument(2, 40), argument(3, 5));
    turn<3>(comm, argument(1, 5) - 1, argument(2, 40) / 2, 1);
  });
}

const Test test("transport/material_points", start);
} // namespace tests::transport_material_points
