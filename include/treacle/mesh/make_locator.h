// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_make_locator_h
#define treacle_mesh_make_locator_h

#include <memory>

namespace treacle
{
  template <int dim>
  class LatticeMesh;

  template <int dim>
  class Locator;

  template <int dim>
  class Mesh;

  /// Over the lattice, or by a tree of cells if there is none. A function of its own, for
  /// locators know the mesh, and the mesh nothing of them. Collective.
  template <int dim>
  std::shared_ptr<const Locator<dim>>
  make_locator(const Mesh<dim> &mesh, std::unique_ptr<const LatticeMesh<dim>> lattice);
} // namespace treacle

#endif
