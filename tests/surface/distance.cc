// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Nearest points on the surface of a box of liquid and of a ball, for nodes in planes of
// symmetry that have several: the same on 1, 2 and 3 ranks. Sides that lean on a wall go on beyond it, each before its own end.
// A marker at the very end of its reach does no harm.

#include <treacle/geometry/shapes.h>
#include <treacle/surface/marker_correction.h>
#include <treacle/surface/surface_distance.h>

#include "../tests.h"

namespace tests::surface_distance
{
using namespace treacle;

template <int dim>
std::shared_ptr<const Mesh<dim>>
uniform_mesh(const MPI_Comm &comm, const unsigned int level)
{
  typename Octree<dim>::Parameters prm;
  prm.upper_corner   = diagonal_point<dim>(1);
  prm.surface_level  = level;
  prm.interior_level = prm.air_level = 0;
  return std::make_shared<const Mesh<dim>>(std::make_shared<const Octree<dim>>(
    comm,
    prm,
    [&](const std::vector<Leaf<dim>> &leaves) {
      std::vector<bool> refine;
      for (const Leaf<dim> &leaf : leaves)
        refine.push_back(leaf.level < level);
      return refine;
    }));
}

/// Sums over the nodes with |x_0 - 1/2| < 1e-9 of the coordinates of their nearest points.
template <int dim>
void
check(const MPI_Comm &comm, const std::string &name, const unsigned int level)
{
  const auto       pointer = uniform_mesh<dim>(comm, level);
  const Mesh<dim> &mesh    = *pointer;
  treacle::Vector  phi     = mesh.zeros(mesh.nodes);
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    {
      double farthest = 0, square = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double r = std::abs(mesh.node_position[node][d] - 0.5);
          farthest       = std::max(farthest, r);
          square += r * r;
        }
      phi.local_element(node) = (name == "box" ? farthest : std::sqrt(square)) - 0.27;
    }
  phi.update_ghost_values();
  const SurfaceDistance<dim> surface(mesh, extract_surface(mesh, phi), 0.4);
  Point<dim>                 sum;
  double                     distance = 0;
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    if (std::abs(mesh.node_position[node][0] - 0.5) < 1e-9)
      {
        const auto nearest = surface.nearest(mesh.node_position[node]);
        if (nearest.distance > 1) // beyond the reach
          continue;
        sum += nearest.point;
        distance += nearest.distance;
      }
  sum = Utilities::MPI::sum(Tensor<1, dim>(sum), comm);
  tests::out() << dim << "D, " << name << ": nearest points " << sum << ", distances "
               << Utilities::MPI::sum(distance, comm) << std::endl;
}

/// A corner of a body that stands on the floor, with two sides at 45 degrees to it, which go on below as planes: no point on the floor is nearer
/// to it than the farther of these, and those before one side are as near as its plane.
void
check_beyond_floor(const MPI_Comm &comm)
{
  const auto       pointer   = uniform_mesh<3>(comm, 4);
  const Mesh<3>   &mesh      = *pointer;
  const auto       to_planes = [](const Point<3> &x) { return (std::max(x[0], x[1]) + x[2] - 0.53) / std::sqrt(2.); };
  treacle::Vector  phi       = mesh.zeros(mesh.nodes);
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    phi.local_element(node) = to_planes(mesh.node_position[node]);
  phi.update_ghost_values();
  const SurfaceDistance<3> surface(mesh, extract_surface(mesh, phi), 0.4);
  double                   too_near = 0, off = 0;
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    if (const Point<3> &x = mesh.node_position[node]; x[2] == 0 && to_planes(x) > 0)
      {
        const double nearer = to_planes(x) - surface.nearest(x).distance;
        too_near            = std::max(too_near, nearer);
        if (std::min(x[0], x[1]) < 0.4 && std::max(x[0], x[1]) < 0.9) // within reach
          off = std::max(off, std::abs(nearer));
      }
  too_near = Utilities::MPI::max(too_near, comm);
  off      = Utilities::MPI::max(off, comm);
  tests::out() << "3D, on the floor beside a corner: nearer than the planes "
               << (too_near < 1e-9 ? "nowhere" : "SOMEWHERE, by " + std::to_string(too_near)) << ", before one side "
               << (off < 1e-9 ? "as near" : "OFF, by " + std::to_string(off)) << std::endl;
}

/// A marker so far from the middle node that it is felt, with the weight 0.
void
check_weightless_marker()
{
  State<2>         state(uniform_mesh<2>(MPI_COMM_SELF, 5));
  const Mesh<2>   &mesh  = *state.mesh;
  const double     reach = 1.25 * mesh.finest_size(), step = 0x1p-53;
  const Point<2>   middle(0.5, 0.5);
  Marker<2>        marker{middle, Point<2>(1, 0)};
  marker.position[0] += reach - step;
  for (unsigned int k = 1;; k += 1000)
    {
      marker.position[1]  = 0.5 + k * step;
      const double square = (middle - marker.position).norm_square();
      AssertThrow(square < reach * reach, ExcMessage("There is no such place."));
      if (std::sqrt(square) / reach == 1)
        break;
    }
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    state.phi.local_element(node) = mesh.node_position[node][0] - 0.53;
  state.phi.update_ghost_values();
  state.markers = {marker};
  MarkerCorrection<2>(state).apply(state);
  tests::out() << "a marker without weight: phi "
               << (std::isfinite(state.phi.l2_norm()) ? "finite" : "NOT FINITE") << std::endl;
}

void
start(const int, char **)
{
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    for (const std::string name : {"box", "ball"})
      {
        check<2>(comm, name, 5);
        check<3>(comm, name, 3);
      }
    check_beyond_floor(comm);
  });
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    check_weightless_marker();
}

const Test test("surface/distance", start);
} // namespace tests::surface_distance
