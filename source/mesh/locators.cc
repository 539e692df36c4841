// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/lattice_locator.h>
#include <treacle/mesh/make_locator.h>
#include <treacle/mesh/tree_locator.h>

namespace treacle
{
  template <int dim>
  std::shared_ptr<const Locator<dim>>
  make_locator(const Mesh<dim> &mesh, std::unique_ptr<const LatticeMesh<dim>> lattice)
  {
    if (lattice)
      return std::make_shared<const LatticeLocator<dim>>(mesh, std::move(lattice));
    return std::make_shared<const TreeLocator<dim>>(mesh);
  }

  template std::shared_ptr<const Locator<2>>
  make_locator(const Mesh<2> &, std::unique_ptr<const LatticeMesh<2>>);
  template std::shared_ptr<const Locator<3>>
  make_locator(const Mesh<3> &, std::unique_ptr<const LatticeMesh<3>>);
} // namespace treacle
