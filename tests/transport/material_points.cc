// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A ball of two halves, one light and thin, one heavy and thick, turns about its centre, rigidly and many
// times: the jump stays within a part of a leaf of where it belongs, and neither half grows, on 1, 2
// and 3 ranks. At rest, a viscosity that is steep but smooth is left alone, and so is the middle of three layers.
// Argument: level, steps a turn, turns.

#include "../liquid.h"
#include "../run_scene.h"
#include "../tests.h"

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
  const std::string l      = std::to_string(level);
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
  const auto          mesh = initial_mesh<dim>(comm, prm.mesh, scene);
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

/// By which factor the viscosity of a cell is off at most, of liquid at rest; cells at the surface, and those
/// closer than @p margin leaves to heights where it jumps, do not count.
template <int dim>
void
rest(const MPI_Comm            &comm,
     const std::string         &name,
     const std::string         &formula,
     const std::vector<double> &jumps,
     const double               margin)
{
  const auto prm = parse<dim>("subsection Mesh\nset Surface level = 4\nset Interior level = 4\nset Air level = 4\n"
                              "end\nsubsection Material\nset Transport = advected\nset Viscosity = " +
                                formula + "\nend\nsubsection Liquid 1\nset Radius = 0.4\nset Centre = 0.5, 0.5" +
                                (dim == 2 ? "" : ", 0.5") + "\nend\n",
                              0,
                              1);
  const Scene<dim>                 scene(prm.scene);
  const auto          mesh = initial_mesh<dim>(comm, prm.mesh, scene);
  const MeshData<dim> data(*mesh, scene);
  State<dim>          state(mesh);
  for (LocalIndex node = 0; node < mesh->n_owned_nodes(); ++node)
    state.phi.local_element(node) = scene.liquid_distance(mesh->node_position[node]);
  state.phi.update_ghost_values();
  set_initial_material(state, data);
  for (unsigned int k = 0; k < 5; ++k)
    settle_material(state, data, 6);
  const WhereLiquidIs<dim> liquid(state, scene);
  double                   factor = 1;
  for (LocalIndex c = 0; c < mesh->n_owned_cells(); ++c)
    if (liquid.domain.liquid_volume[c] > 0)
      {
        const Point<dim> &x = liquid.domain.liquid_centre[c];
        if (scene.liquid_distance(x) > -2 * mesh->finest_size() || std::any_of(jumps.begin(), jumps.end(), [&](const double y) {
              return std::abs(x[1] - y) < margin * mesh->finest_size();
            }))
          continue;
        const double ratio = liquid.domain.viscosity[c] / scene.initial_material(x).viscosity(x, 0);
        factor             = std::max({factor, ratio, 1 / ratio});
      }
  factor = Utilities::MPI::max(factor, comm);
  out() << dim << "D, " << name << ": off by a factor of " << std::setprecision(2) << factor << " at most"
        << std::endl;
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
    rest<2>(comm, "exponential", "10^(6*y)", {}, 0);
    rest<3>(comm, "exponential", "10^(6*y)", {}, 0);
    rest<2>(comm, "three layers", "if(y<0.4,1,if(y<0.6,100,10000))", {0.4, 0.6}, 1.2);
    rest<3>(comm, "three layers", "if(y<0.4,1,if(y<0.6,100,10000))", {0.4, 0.6}, 1.2);
  });
}

const Test test("transport/material_points", start);
} // namespace tests::transport_material_points
