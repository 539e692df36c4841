// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_initial_mesh_h
#define treacle_transport_initial_mesh_h

#include <treacle/mesh/mesh.h>
#include <treacle/scene/scene.h>

namespace treacle
{
  /// A mesh for the liquids of the scene at t = 0. Collective.
  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  initial_mesh(const MPI_Comm                         &comm,
               const typename Octree<dim>::Parameters &parameters,
               const Scene<dim>                       &scene);
} // namespace treacle

#endif
