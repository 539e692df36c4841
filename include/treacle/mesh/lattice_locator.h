// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_lattice_locator_h
#define treacle_mesh_lattice_locator_h

#include <treacle/mesh/lattice_mesh.h>
#include <treacle/mesh/locator.h>

namespace treacle
{
  /// On a lattice there is no search: the octree gives the leaf, the largest component of
  /// x - centre the face of the leaf over which the cell stands.
  template <int dim>
  class LatticeLocator : public Locator<dim>
  {
  public:
    using Owner = typename Locator<dim>::Owner;

    LatticeLocator(const Mesh<dim> &mesh, std::unique_ptr<const LatticeMesh<dim>> lattice)
      : Locator<dim>(mesh, lattice->covering_boxes())
      , lattice(std::move(lattice))
    {}

    Location<dim>
    locate(const Point<dim> &x) const override;

    Location<dim>
    locate_here(const Point<dim> &x) const override
    {
      return locate(x);
    }

    std::vector<Owner>
    owners(const std::vector<Point<dim>> &x) const override;

    std::vector<Point<dim>>
    clamped(const std::vector<Point<dim>> &x) const override;

  private:
    /// The cells that may contain x, in the leaf with this index.
    void
    find_candidates(const Point<dim> &x, const LocalIndex leaf) const;

    using Locator<dim>::candidates;

    const std::unique_ptr<const LatticeMesh<dim>> lattice;
  };
} // namespace treacle

#endif
