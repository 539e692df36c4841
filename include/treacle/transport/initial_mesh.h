// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_initial_mesh_h
#define treacle_transport_initial_mesh_h

#include <treacle/mesh/mesh.h>
#include <treacle/scene/scene.h>

namespace treacle
{
  /// In the box of the scene.
  template <int dim>
  typename Octree<dim>::Parameters
  with_box(typename Octree<dim>::Parameters mesh, const Scene<dim> &scene)
  {
    mesh.lower_corner = scene.lower_corner();
    mesh.upper_corner = scene.upper_corner();
    return mesh;
  }

  /// A mesh for the liquids of the scene at t = 0, in its box. Collective.
  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  initial_mesh(const MPI_Comm                         &comm,
               const typename Octree<dim>::Parameters &parameters,
               const Scene<dim>                       &scene);
} // namespace treacle

#endif
