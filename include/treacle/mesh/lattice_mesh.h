// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_lattice_mesh_h
#define treacle_mesh_lattice_mesh_h

#include <treacle/mesh/mesh_cells.h>
#include <treacle/mesh/octree.h>

#include <deal.II/base/bounding_box.h>

#include <map>

namespace treacle
{
  /// The cells of a mesh that stand on the lattice of an octree, and which of them
  /// stand over a face of a leaf.
  template <int dim>
  class LatticeMesh
  {
  public:
    /// Collective.
    explicit LatticeMesh(std::shared_ptr<const Octree<dim>> octree);

    const Octree<dim> &
    octree() const
    {
      return *tree;
    }

    /// To be taken once.
    MeshCells<dim>
    take_cells()
    {
      return std::move(cells);
    }

    /// Cells over face f of a known leaf whose cells this rank holds.
    /// Owned leaves, and equal neighbours below one, are complete.
    void
    cells_over(const Leaf<dim>         &leaf,
               const unsigned int       face,
               std::vector<LocalIndex> &result) const;

    /// The same of an owned leaf, the @p l-th.
    void
    cells_over(const LocalIndex l, const unsigned int face, std::vector<LocalIndex> &result) const;

    /// Boxes around the cells on owned leaves.
    std::vector<BoundingBox<dim>>
    covering_boxes() const;

  private:
    struct Record;

    std::vector<Record>
    make_records();

    void
    take(const std::vector<Record> &records);

    std::shared_ptr<const Octree<dim>> tree;
    MeshCells<dim>                     cells;
    std::vector<unsigned int>          start; ///< of the lattice's owned leaves
    /// Ghost cells by the leaf they stand on, and its face.
    std::map<std::pair<VertexKey, unsigned int>, std::vector<LocalIndex>> ghosts_over;
  };
} // namespace treacle

#endif
