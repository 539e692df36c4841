// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A checkpoint written on 2 ranks is the same state on 1, 2 and 3; what cannot
// be resumed is refused; a half-written one is no harm.

#include <treacle/base/exceptions.h>
#include <treacle/base/exchange.h>
#include <treacle/fields/moved_points.h>
#include <treacle/io/checkpoint.h>
#include <treacle/io/row_order.h>

#include <filesystem>

#include "../tests.h"
#include "ball.h"

namespace tests::io_checkpoint
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
    checkpoint<dim>(comm).load(tests::ball_mesh<dim>());
  const double worst    = difference<dim>(state, comm);
  const bool   are_same = same_markers<dim>(state, comm);
  tests::out() << dim << "D: time " << state.time << ", step " << state.step << ", frame "
               << progress.frame << ", scalar "
               << (progress.scalars.at("first volume") == 1. / 3 ? "ok" : "WRONG")
               << ", state "
               << (worst == 0 && state.mesh->octree().size_factor() == 1.5625 ? "ok" : "WRONG") << ", markers "
               << (are_same ? "ok" : "WRONG") << std::endl;
}

template <int dim>
void
refuse(const MPI_Comm &comm, const typename Octree<dim>::Parameters &parameters)
{
  try
    {
      checkpoint<dim>(comm).load(parameters);
      tests::out() << "no error" << std::endl;
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

void
replace_in_info(const std::string &old, const std::string &now)
{
  const std::string path = "out2/checkpoint/info";
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  std::string all = text.str();
  all.replace(all.find(old), old.size(), now);
  std::ofstream(path) << all;
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
  fs::resize_file("out3/checkpoint.new/numbers", 1000);
  fs::rename("out3/checkpoint.new", "out2/checkpoint");
  refuse<2>(comm, tests::ball_mesh<2>());
  fs::resize_file("out2/checkpoint/leaves", 36);
  refuse<2>(comm, tests::ball_mesh<2>());
  replace_in_info("Format = 10", "Format = 9");
  refuse<2>(comm, tests::ball_mesh<2>());
  checkpoint<2>(comm).remove();
  refuse<2>(comm, tests::ball_mesh<2>());
}

/// The vectors of a material.
template <typename Material>
auto
parts_of(Material &material)
{
  auto &[density, viscosity, points] = material;
  return std::array<decltype(std::ref(density.mean)), 6>{{std::ref(density.mean),
                                                          std::ref(density.least),
                                                          std::ref(density.largest),
                                                          std::ref(viscosity.mean),
                                                          std::ref(viscosity.least),
                                                          std::ref(viscosity.largest)}};
}

/// An order that one rank on a single cell could not tell: a checkpoint of a run with
/// material, and the velocity before at nodes or faces.
template <int dim>
void
check_all_parts(const MPI_Comm &comm, const bool at_nodes)
{
  const auto make = [&] {
    State<dim> state = tests::ball_state<dim>(comm);
    state.material.emplace(state.mesh->nodes);
    double factor = 1;
    for (const auto &part : parts_of(*state.material))
      part.get().equ(++factor, state.phi);
    for (const auto &marker : state.markers)
      state.material->points.push_back({marker.position, marker.normal[0], marker.normal[1], marker.position[0], -marker.normal[1]});
    state.material->update_ghost_values();
    state.before.emplace();
    state.before->dt = 0.1;
    if (at_nodes)
      {
        state.before->v       = state.v;
        state.before->v_along = state.v;
        for (treacle::Vector &component : state.before->v_along->component)
          component *= 2;
      }
    state.before->u = state.u;
    state.phi = -0.;
    state.phi.update_ghost_values();
    return state;
  };
  const State<dim> saved = make();
  checkpoint<dim>(comm).write(saved, {1, {}});
  const State<dim> loaded =
    checkpoint<dim>(comm).load(tests::ball_mesh<dim>()).first;
  bool       same = loaded.before->dt == 0.1;
  const auto add  = [&](const treacle::Vector &a, const treacle::Vector &b) {
    for (unsigned int i = 0; i < a.locally_owned_size() + a.get_partitioner()->n_ghost_indices(); ++i)
      same = same && a.local_element(i) == b.local_element(i) &&
             std::signbit(a.local_element(i)) == std::signbit(b.local_element(i));
  };
  add(loaded.phi, saved.phi);
  for (unsigned int k = 0; k < 6; ++k)
    add(parts_of(*loaded.material)[k], parts_of(*saved.material)[k]);
  const auto &points = loaded.material->points, &saved_points = saved.material->points;
  same = same && points.size() == saved_points.size();
  for (unsigned int k = 0; k < points.size(); ++k)
    same = same && points[k].numbers() == saved_points[k].numbers();
  if (at_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      {
        add(loaded.before->v->component[d], saved.before->v->component[d]);
        add(loaded.before->v_along->component[d], saved.before->v_along->component[d]);
      }
  add(*loaded.before->u, *saved.before->u);
  // numbers: phi, v, material (and v, v_along) of each node, u of each face, pressures
  const Mesh<dim>    &mesh = *saved.mesh;
  const std::uint64_t n_numbers =
    mesh.nodes->size() * (7 + (at_nodes ? 3 : 1) * dim) +
    mesh.faces->size() * 2 + mesh.cells->size();
  const bool is_small =
    std::filesystem::file_size("out" + std::to_string(dim) + "/checkpoint/numbers") == 8 * n_numbers;
  tests::out() << dim << "D, velocity before at " << (at_nodes ? "nodes and faces" : "faces") << ": "
               << (Utilities::MPI::min(same ? 1 : 0, comm) == 1 ? "the same bits" : "WRONG")
               << ", each number " << (is_small ? "once" : "NOT ONCE") << std::endl;
}

/// Shares of more numbers than 32 bits count, and messages in parts.
void
check_large_counts(const MPI_Comm &comm)
{
  const std::uint64_t n_rows = 3000000000u, n_ranks = 7;
  std::uint64_t       next = 0;
  bool                fits = true;
  for (unsigned int r = 0; r < n_ranks; ++r)
    {
      const Share share = share_of(r, n_ranks, n_rows);
      fits              = fits && share.first == next && share.n > 0;
      next += share.n;
    }
  PerRank<int> numbers(Utilities::MPI::n_mpi_processes(comm));
  for (auto &to_rank : numbers)
    for (int k = 0; k < 20; ++k)
      to_rank.push_back(k * k);
  const bool same = send_and_receive(comm, numbers, 7) == numbers;
  tests::out() << "shares of 3e9 rows " << (fits && next == n_rows ? "ok" : "WRONG")
               << ", messages in parts "
               << (Utilities::MPI::min(same ? 1 : 0, comm) == 1 ? "ok" : "WRONG") << std::endl;
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
  tests::in_turn_on_1_2_3_ranks([](const MPI_Comm &comm) {
    load<2>(comm);
    load<3>(comm);
  });
  if (rank == 0)
    check_errors(MPI_COMM_SELF);
  check_large_counts(MPI_COMM_WORLD);
  for (const bool at_nodes : {false, true})
    {
      check_all_parts<2>(MPI_COMM_WORLD, at_nodes);
      check_all_parts<3>(MPI_COMM_WORLD, at_nodes);
    }
}

const Test test("io/checkpoint", start);
} // namespace tests::io_checkpoint
