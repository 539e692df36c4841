// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A checkpoint written on 2 ranks is the same state on 1, 2 and 3; what cannot
// be resumed is refused; a half-written one is no harm.

#include <treacle/base/exceptions.h>
#include <treacle/io/checkpoint.h>

#include <filesystem>

#include "../tests.h"
#include "ball.h"

namespace tests::checkpoint_test
{
using namespace treacle;

template <int dim>
Checkpoint<dim>
checkpoint(const MPI_Comm &comm)
{
  return Checkpoint<dim>(comm, {}, "out" + std::to_string(dim));
}

/// The largest difference to the state that was saved; 0 where all bits agree.
template <int dim>
double
difference(const State<dim> &loaded, const MPI_Comm &comm)
{
  const State<dim> saved  = tests::ball_state<dim>(comm);
  double           result = 0;
  const auto       add    = [&](const treacle::Vector &a, const treacle::Vector &b) {
    // ghosts too
    for (unsigned int i = 0; i < a.get_partitioner()->locally_owned_size() +
                                   a.get_partitioner()->n_ghost_indices();
         ++i)
      result = std::max(result, std::abs(a.local_element(i) - b.local_element(i)));
  };
  add(loaded.phi, saved.phi);
  add(loaded.u, saved.u);
  add(loaded.pressure, saved.pressure);
  for (unsigned int d = 0; d < dim; ++d)
    add(loaded.v.component[d], saved.v.component[d]);
  return Utilities::MPI::max(result, comm);
}

/// Do the ranks hold the markers that were saved, each the ones in its leaves?
template <int dim>
bool
same_markers(const State<dim> &loaded, const MPI_Comm &comm)
{
  const Octree<dim>                              &octree  = loaded.mesh->octree();
  std::vector<typename Marker<dim>::Numbers> numbers, wanted;
  bool                                            is_here = true;
  for (const Marker<dim> &marker : loaded.markers)
    {
      numbers.push_back(marker.numbers());
      is_here = is_here && octree.leaf_containing(marker.position) < octree.n_owned_leaves();
    }
  std::vector<typename Marker<dim>::Numbers> all;
  for (const auto &part : Utilities::MPI::all_gather(comm, numbers))
    all.insert(all.end(), part.begin(), part.end());
  for (const Marker<dim> &marker : tests::ball_markers<dim>())
    wanted.push_back(marker.numbers());
  std::sort(all.begin(), all.end());
  std::sort(wanted.begin(), wanted.end());
  return Utilities::MPI::min(is_here && all == wanted ? 1 : 0, comm) == 1;
}

template <int dim>
void
write(const MPI_Comm &comm)
{
  State<dim> state = tests::ball_state<dim>(comm);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    state.markers = tests::ball_markers<dim>();
  state.markers = to_owners(*state.mesh, state.markers);
  state.time    = 0.1;
  state.step       = 6;
  checkpoint<dim>(comm).write(state, {3, {}});
  state.time = 0.2;
  state.step = 7;
  checkpoint<dim>(comm).write(state, {4, {{"first volume", 1. / 3}}});
}

template <int dim>
void
load(const MPI_Comm &comm)
{
  const auto [state, progress] =
    checkpoint<dim>(comm).load(tests::ball_mesh<dim>(), tests::leaf_weight<dim>);
  const double worst    = difference<dim>(state, comm);
  const bool   are_same = same_markers<dim>(state, comm);
  tests::out() << dim << "D: time " << state.time << ", step " << state.step << ", frame "
               << progress.frame << ", scalar "
               << (progress.scalars.at("first volume") == 1. / 3 ? "ok" : "WRONG")
               << ", state " << (worst == 0 ? "ok" : "WRONG") << ", markers "
               << (are_same ? "ok" : "WRONG") << std::endl;
}

template <int dim>
void
refuse(const MPI_Comm &comm, const typename Octree<dim>::Parameters &parameters)
{
  try
    {
      checkpoint<dim>(comm).load(parameters, tests::leaf_weight<dim>);
      tests::out() << "no error" << std::endl;
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

void
check_errors(const MPI_Comm &comm)
{
  namespace fs             = std::filesystem;
  auto parameters          = tests::ball_mesh<2>();
  parameters.surface_level = 7;
  refuse<2>(comm, parameters);
  parameters                 = tests::ball_mesh<2>();
  parameters.upper_corner[1] = 2;
  refuse<2>(comm, parameters);

  // killed between the two renames, then while the next one is written
  fs::rename("out2/checkpoint", "out2/checkpoint.new");
  load<2>(comm);
  fs::rename("out2/checkpoint.new", "out2/checkpoint.old");
  fs::create_directory("out2/checkpoint.new");
  load<2>(comm);
  fs::rename("out2/checkpoint.old", "out3/checkpoint.new");
  fs::remove_all("out3/checkpoint");
  refuse<3>(comm, tests::ball_mesh<3>());
  fs::resize_file("out3/checkpoint.new/cells", 1000);
  fs::rename("out3/checkpoint.new", "out2/checkpoint");
  refuse<2>(comm, tests::ball_mesh<2>());
  checkpoint<2>(comm).remove();
  refuse<2>(comm, tests::ball_mesh<2>());
}

void
start(const int, char **)
{
  const int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  MPI_Comm  two;
  MPI_Comm_split(MPI_COMM_WORLD, rank < 2 ? 0 : 1, rank, &two);
  if (rank < 2)
    {
      write<2>(two);
      write<3>(two);
    }
  MPI_Comm_free(&two);
  MPI_Barrier(MPI_COMM_WORLD);
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    load<2>(comm);
    load<3>(comm);
  });
  if (rank == 0)
    check_errors(MPI_COMM_SELF);
}

const Test test("io/checkpoint", start);
} // namespace tests::checkpoint_test
