// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The figures that the graded lattice must reach (doc/mesh.md): conforming,
// weighted Delaunay with known smallest dual lengths, sum A L n n^T = V I.
// Runs on 1, 2 and 3 ranks in turn: every block of lines must be the same.
// Argument: level of the surface leaves (default 4 and three random octrees; 6
// gives the figures of the reference and ten).

#include <treacle/mesh/mesh.h>

#include "../tests.h"

#include <random>

namespace tests::mesh_lattice
{
using namespace treacle;

template <int dim>
std::shared_ptr<const Octree<dim>>
make_octree(const MPI_Comm &comm, const int seed, const unsigned int level)
{
  typename Octree<dim>::Parameters prm;
  for (unsigned int d = 0; d < dim; ++d)
    prm.upper_corner[d] = 1;
  prm.surface_level  = level;
  prm.interior_level = 2;
  prm.air_level      = 2;
  const int root    = 2 << level;
  const auto distance = [&](const Leaf<dim> &leaf) {
    double d2 = 0;
    for (unsigned int d = 0; d < dim; ++d)
      d2 += std::pow(leaf.origin[d] + 0.5 * leaf.size - 0.5 * root - 0.013 * leaf.size, 2);
    return std::abs(std::sqrt(d2) - 0.3 * root);
  };
  return std::make_shared<const Octree<dim>>(
    comm,
    prm,
    [&](const std::vector<Leaf<dim>> &leaves) {
      std::vector<bool> refine;
      for (const Leaf<dim> &leaf : leaves)
        if (leaf.level < 2)
          refine.push_back(true);
        else if (seed == 0)
          refine.push_back(distance(leaf) < 0.87 * leaf.size + 1);
        else
          {
            // random, but the same on any rank
            std::mt19937 generator(seed * 7919 + leaf.level * 104729 +
                                   static_cast<unsigned int>(pack<dim>(leaf.origin) % 1000003));
            generator.discard(5);
            refine.push_back(generator() % 100 < 30);
          }
      return refine;
    });
}

template <int dim>
double
largest_dihedral(const Simplex<dim> &x, double &smallest)
{
  const auto g       = basis_gradients<dim>(x);
  double     largest = 0;
  for (unsigned int i = 0; i <= dim; ++i)
    for (unsigned int j = i + 1; j <= dim; ++j)
      {
        const double angle =
          std::acos(-(g[i] * g[j]) / g[i].norm() / g[j].norm()) * 180 / numbers::PI;
        smallest = std::min(smallest, angle);
        largest  = std::max(largest, angle);
      }
  return largest;
}

template <int dim>
void
check(const MPI_Comm &comm, const int seed, const unsigned int level)
{
  const Mesh<dim> mesh(make_octree<dim>(comm, seed, level));

  double       volume = 0, shortest = 1e300, smallest = 180, largest = 0;
  unsigned int nonconforming = 0, inverted = 0;
  for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
    {
      volume += mesh.cell_volume[c];
      inverted += mesh.cell_volume[c] <= 0;
      largest = std::max(largest, largest_dihedral<dim>(mesh.cell_vertices(c), smallest));
    }
  Tensor<2, dim> identity;
  for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
    {
      const auto &cells = mesh.face_cells[f];
      if (cells[1] == invalid)
        nonconforming += mesh.face_side[f] == Mesh<dim>::no_side;
      else
        shortest = std::min(shortest,
                            mesh.face_dual_length[f] /
                              std::min(mesh.cell_size[cells[0]], mesh.cell_size[cells[1]]));
      // on the box the dual edge ends at the face's centre, beside the foot of o
      const Tensor<1, dim> dual_edge =
        cells[1] == invalid ? mesh.face_centre(f) - mesh.cell_dual[cells[0]] :
                              mesh.face_dual_length[f] * mesh.face_normal[f];
      identity += mesh.face_area[f] * outer_product(mesh.face_normal[f], dual_edge);
    }
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      identity[i][j] = Utilities::MPI::sum(identity[i][j], comm) - (i == j);
  volume        = Utilities::MPI::sum(volume, comm);
  nonconforming = Utilities::MPI::sum(nonconforming + inverted, comm);
  shortest      = Utilities::MPI::min(shortest, comm);
  smallest      = Utilities::MPI::min(smallest, comm);
  largest       = Utilities::MPI::max(largest, comm);

  tests::out() << dim << "D " << (seed == 0 ? "sphere" : "random " + std::to_string(seed))
               << ": cells " << mesh.cells->size() << ", nodes " << mesh.nodes->size()
               << ", faces " << mesh.faces->size() << ", non-conforming or inverted "
               << nonconforming << ", volume " << volume << (std::abs(volume - 1) < 1e-11 ? " ok" : " WRONG")
               << ", shortest dual " << std::round(shortest * 1e4) / 1e4 << ", dihedral "
               << std::round(smallest * 10) / 10 << " to " << std::round(largest * 10) / 10
               << ", identity " << (identity.norm() < 1e-12 ? "ok" : "off by " + std::to_string(identity.norm()))
               << std::endl;
}

void
start(const int argc, char **argv)
{
  const unsigned int level = argc > 1 ? std::stoi(argv[1]) : 4;
  tests::on_1_2_3_ranks([&](const MPI_Comm &comm) {
    for (int seed = 0; seed <= (level > 4 ? 10 : 3); ++seed)
      {
        check<2>(comm, seed, level + 1);
        check<3>(comm, seed, seed == 0 ? level : level > 4 ? 4 : 3);
      }
  });
}

const Test test("mesh/lattice", start);
} // namespace tests::mesh_lattice
