// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_tree_locator_h
#define treacle_mesh_tree_locator_h

#include <treacle/mesh/cell_tree.h>
#include <treacle/mesh/locator.h>

namespace treacle
{
  /// In a mesh from a file: by an R-tree of the boxes of the cells. Where several cells
  /// contain a point, as on a face, the one of the lowest number counts.
  template <int dim>
  class TreeLocator : public Locator<dim>
  {
  public:
    using Owner = typename Locator<dim>::Owner;

    /// Collective.
    explicit TreeLocator(const Mesh<dim> &mesh);

    Location<dim>
    locate(const Point<dim> &x) const override;

    Location<dim>
    locate_here(const Point<dim> &x) const override;

    std::vector<Owner>
    owners(const std::vector<Point<dim>> &x) const override;

    std::vector<Owner>
    owners_elsewhere(const std::vector<Point<dim>> &x) const override;

    std::vector<Point<dim>>
    clamped(const std::vector<Point<dim>> &x) const override;

  private:
    /// The cell of the lowest number that contains x. With @p owned, of owned ones;
    /// else of all, but invalid if no owned one contains it: what does not touch the
    /// cells of this rank is only partly known here.
    Location<dim>
    in_tree(const Point<dim> &x, const bool owned) const;

    Location<dim>
    on_wall(const typename CellTree<dim>::Nearest &nearest) const;

    using Locator<dim>::mesh;
    using Locator<dim>::candidates;

    const CellTree<dim> tree;
  };
} // namespace treacle

#endif
