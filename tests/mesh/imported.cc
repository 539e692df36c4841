// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Meshes from files on 1, 2 and 3 ranks: counts, volume, walls, and the identity
// sum A L n n^T = V I where no dual length is clamped, which weights see to at the sides of a body-centred box; points in and around them are
// located the same on all ranks, and linear fields are exact there.

#include <treacle/mesh/tracer.h>

#include "../tests.h"
#include "../mesh_files.h"

namespace tests::mesh_imported
{
using namespace treacle;

template <int dim>
void
check_mesh(const Mesh<dim> &mesh)
{
  const MPI_Comm &comm   = mesh.communicator();
  double          volume = 0, shortest = 1e300;
  Tensor<2, dim>  identity;
  std::vector<unsigned int> n_walls(Walls<dim>::n);
  for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
    volume += mesh.cell_volume[c];
  for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
    {
      const bool is_wall = mesh.face_side[f] != mesh.no_side;
      AssertThrow(is_wall == (mesh.face_cells[f][1] == invalid), ExcInternalError());
      if (is_wall)
        ++n_walls[mesh.face_side[f]];
      else
        shortest = std::min(shortest, mesh.face_dual_length[f] / mesh.finest_size());
      const Tensor<1, dim> dual_edge =
        is_wall ? mesh.face_centre(f) - mesh.cell_dual[mesh.face_cells[f][0]] :
                  mesh.face_dual_length[f] * mesh.face_normal[f];
      identity += mesh.face_area[f] * outer_product(mesh.face_normal[f], dual_edge);
    }
  volume = Utilities::MPI::sum(volume, comm);
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      identity[i][j] = Utilities::MPI::sum(identity[i][j], comm) - volume * (i == j);
  tests::out() << "  cells " << mesh.cells->size() << ", nodes " << mesh.nodes->size()
               << ", faces " << mesh.faces->size() << ", volume " << volume
               << ", clamped dual lengths " << mesh.n_clamped_dual_lengths << ", shortest "
               << Utilities::MPI::min(shortest, comm) << ", identity "
               << (identity.norm() < 1e-12 ? "ok" : "off") << ", walls";
  for (const unsigned int n : n_walls)
    tests::out() << ' ' << Utilities::MPI::sum(n, comm);
  tests::out() << std::endl;
}

template <int dim>
void
check_points(const Mesh<dim> &mesh, const bool is_box)
{
  // all ranks ask for the same points: some in the mesh, on its vertices, around it
  const MPI_Comm                        &comm = mesh.communicator();
  std::mt19937                           generator(17);
  std::uniform_real_distribution<double> random(-0.3, 1.3);
  std::vector<Point<dim>>                x;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      x.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        x.back()[d] = i < 200 ? std::round(8 * random(generator)) / 8 : random(generator);
    }
  const auto      linear = [](const Point<dim> &p) { return 2 * p[0] - 3 * p[dim - 1] + 0.5; };
  treacle::Vector field  = mesh.zeros(mesh.nodes);
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    field.local_element(node) = linear(mesh.node_position[node]);
  field.update_ghost_values();

  const std::vector<Point<dim>> moved  = mesh.locator().clamped(x);
  const std::vector<double>     values = Tracer<dim>(mesh).evaluate(x, {{&field}});
  const auto                    owners = mesh.locator().owners(x);
  double                        error = 0, distance = 0, difference = 0;
  unsigned int                  n_moved = 0;
  for (unsigned int i = 0; i < x.size(); ++i)
    {
      error = std::max({error,
                        std::abs(values[i] - linear(moved[i])),
                        moved[i].distance(owners[i].point)});
      distance += moved[i].distance(x[i]);
      n_moved += moved[i].distance(x[i]) > 1e-10;
      for (unsigned int d = 0; d < dim && is_box; ++d)
        error = std::max(error, std::abs(moved[i][d] - std::min(1., std::max(0., x[i][d]))));
      for (const double same : {moved[i][0], moved[i][dim - 1], 1. * owners[i].rank})
        difference = std::max(difference,
                              Utilities::MPI::max(same, comm) - Utilities::MPI::min(same, comm));
    }
  tests::out() << "  points: " << n_moved << " moved into the mesh by " << distance << ", values "
               << (Utilities::MPI::max(error, comm) < 1e-12 ? "exact" : "WRONG")
               << ", ranks " << (difference < 1e-14 ? "agree" : "DIFFER") << std::endl;
}

template <int dim>
void
check(const MPI_Comm &comm, const std::string &name, const bool is_box, const std::function<void(const std::string &)> &write)
{
  const std::string path = name + std::to_string(dim) + ".msh";
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    write(path);
  const Mesh<dim> mesh(comm, path);
  tests::out() << dim << "D, " << name << std::endl;
  check_mesh(mesh);
  check_points(mesh, is_box);
}

template <int dim>
void
check(const MPI_Comm    &comm,
      const std::string &name,
      const unsigned int n,
      const bool         squeezed,
      const double       jitter)
{
  check<dim>(comm, name, !squeezed, [&](const std::string &path) { tests::write_box<dim>(path, n, squeezed, jitter); });
}

void
start(const int, char **)
{
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm, "box", 8, false, 0);
    check<2>(comm, "jittered", 8, false, 0.2);
    check<2>(comm, "squeezed", 12, true, 0);
    check<3>(comm, "box", 4, false, 0);
    check<3>(comm, "jittered", 4, false, 0.2);
    check<3>(comm, "squeezed", 5, true, 0);
    check<3>(comm, "body-centred", true, [](const std::string &path) { tests::write_body_centred(path, 4); });
  });
}

const Test test("mesh/imported", start);
} // namespace tests::mesh_imported
