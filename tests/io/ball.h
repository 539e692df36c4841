// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_io_ball_h
#define treacle_tests_io_ball_h

#include <treacle/fields/state.h>
#include <treacle/scene/scene.h>

namespace tests
{
  using namespace treacle;

  /// A scene with a ball of radius 0.3 in the unit box.
  template <int dim>
  typename Scene<dim>::Parameters
  ball_scene()
  {
    typename Scene<dim>::Parameters parameters;
    parameters.liquids.resize(1);
    parameters.liquids[0].shape.radius = 0.3;
    parameters.material.viscosity               = "2";
    return parameters;
  }

  template <int dim>
  typename Octree<dim>::Parameters
  ball_mesh()
  {
    typename Octree<dim>::Parameters parameters;
    parameters.upper_corner   = diagonal_point<dim>(1);
    parameters.interior_level = 0;
    parameters.air_level      = 0;
    parameters.surface_level  = dim == 2 ? 5 : 3;
    return parameters;
  }

  /// Points on the ball, of all ranks.
  template <int dim>
  std::vector<Marker<dim>>
  ball_markers()
  {
    std::vector<Marker<dim>> markers;
    for (unsigned int k = 0; k < 101; ++k)
      {
        Tensor<1, dim> n;
        for (unsigned int d = 0; d < dim; ++d)
          n[d] = std::sin(k * (d + 1.) + d);
        n /= n.norm();
        markers.push_back({diagonal_point<dim>(0.5) + 0.3 * n, n});
      }
    return markers;
  }

  /// The ball, turning and strained, on a mesh that is fine around its surface.
  template <int dim>
  State<dim>
  ball_state(const MPI_Comm &comm)
  {
    const Point<dim> c      = diagonal_point<dim>(0.5);
    const auto       finest = (dim == 2 ? 64. : 16.);
    const auto       octree = std::make_shared<const Octree<dim>>(
      comm,
      ball_mesh<dim>(),
      [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<bool> refine;
        for (const Leaf<dim> &leaf : leaves)
          {
            Point<dim> x;
            for (unsigned int d = 0; d < dim; ++d)
              x[d] = leaf.centre()[d] / finest;
            refine.push_back(leaf.level < 1 ||
                             std::abs(x.distance(c) - 0.3) < (leaf.size + 2) / finest);
          }
        return refine;
      },
      [](const std::vector<Leaf<dim>> &leaves) {
        std::vector<unsigned int> weights;
        for (const Leaf<dim> &leaf : leaves)
          weights.push_back(leaf.size == 2 ? 3 : 1);
        return weights;
      },
      1.5625);
    State<dim>       state(std::make_shared<const Mesh<dim>>(octree));
    const Mesh<dim> &mesh     = *state.mesh;
    const auto       velocity = [&](const Point<dim> &x) {
      Tensor<1, dim> v = x - c;
      v[0]             = -2 * (x[1] - 0.5) + 0.25;
      v[1]             = 2 * (x[0] - 0.5);
      return v;
    };
    for (LocalIndex n = 0; n < mesh.n_owned_nodes(); ++n)
      {
        const Point<dim> &x        = mesh.node_position[n];
        state.phi.local_element(n) = x.distance(c) - 0.3;
        state.v.set(n, velocity(x));
      }
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      state.u.local_element(f) = mesh.face_normal[f] * velocity(mesh.face_centre(f));
    for (LocalIndex k = 0; k < mesh.n_owned_cells(); ++k)
      state.pressure.local_element(k) = std::sin(mesh.cell_dual[k][0]);
    state.phi.update_ghost_values();
    state.v.update_ghost_values();
    state.u.update_ghost_values();
    state.pressure.update_ghost_values();
    return state;
  }
} // namespace tests

#endif
