// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A state on a mesh from a file, saved on 2 ranks, is the same on 1, 2 and 3, though
// each parts the mesh in another way; another mesh is refused.

#include <treacle/base/exceptions.h>
#include <treacle/io/checkpoint.h>

#include "../mesh_files.h"
#include "../tests.h"

namespace tests::io_imported_checkpoint
{
using namespace treacle;

template <int dim>
State<dim>
make_state(const MPI_Comm &comm)
{
  State<dim> state(
    std::make_shared<const Mesh<dim>>(comm, "box" + std::to_string(dim) + ".msh"));
  const Mesh<dim> &mesh = *state.mesh;
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    {
      const Point<dim> &x           = mesh.node_position[node];
      state.phi.local_element(node) = x[dim - 1] - 0.51 + 0.1 * x[0];
      state.v.set(node, x);
    }
  for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
    state.u.local_element(f) = mesh.face_normal[f] * mesh.face_centre(f);
  for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
    state.pressure.local_element(c) = std::sin(mesh.cell_dual[c][0]);
  for (treacle::Vector *v : {&state.phi, &state.u, &state.pressure})
    v->update_ghost_values();
  state.v.update_ghost_values();
  return state;
}

template <int dim>
Checkpoint<dim>
checkpoint(const MPI_Comm &comm)
{
  return Checkpoint<dim>(comm, {}, "out" + std::to_string(dim));
}

template <int dim>
void
load(const MPI_Comm &comm)
{
  const State<dim> saved         = make_state<dim>(comm);
  const auto [loaded, progress]  = checkpoint<dim>(comm).load(saved.mesh);
  double     difference          = 0;
  const auto add = [&](const treacle::Vector &a, const treacle::Vector &b) {
    for (unsigned int i = 0; i < a.locally_owned_size() + a.get_partitioner()->n_ghost_indices();
         ++i)
      difference = std::max(difference, std::abs(a.local_element(i) - b.local_element(i)));
  };
  add(loaded.phi, saved.phi);
  add(loaded.u, saved.u);
  add(loaded.pressure, saved.pressure);
  for (unsigned int d = 0; d < dim; ++d)
    add(loaded.v.component[d], saved.v.component[d]);
  tests::out() << dim << "D: frame " << progress.frame << ", state "
               << (Utilities::MPI::max(difference, comm) < 1e-15 ? "ok" : "WRONG") << std::endl;
}

template <int dim>
void
write(const MPI_Comm &comm)
{
  checkpoint<dim>(comm).write(make_state<dim>(comm), {3, {}});
}

void
start(const int, char **)
{
  const int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  if (rank == 0)
    {
      tests::write_box<2>("box2.msh", 8, false, 0.2);
      tests::write_box<3>("box3.msh", 4, false, 0.2);
    }
  MPI_Comm two;
  MPI_Comm_split(MPI_COMM_WORLD, rank < 2 ? 0 : 1, rank, &two);
  if (rank < 2)
    {
      write<2>(two);
      write<3>(two);
    }
  MPI_Comm_free(&two);
  MPI_Barrier(MPI_COMM_WORLD);
  tests::in_turn_on_1_2_3_ranks([](const MPI_Comm &comm) {
    load<2>(comm);
    load<3>(comm);
  });
  if (rank == 0)
    {
      for (const auto &[n, jitter] : {std::make_pair(9u, 0.2), std::make_pair(8u, 0.20001)})
        {
          tests::write_box<2>("box2.msh", n, false, jitter);
          try
            {
              load<2>(MPI_COMM_SELF);
              tests::out() << "no error" << std::endl;
            }
          catch (const UserError &error)
            {
              tests::out() << error.what() << std::endl;
            }
        }
    }
}

const Test test("io/imported_checkpoint", start);
} // namespace tests::io_imported_checkpoint
