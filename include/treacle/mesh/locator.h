// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_locator_h
#define treacle_mesh_locator_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// A cell, a point in it and its barycentric coordinates.
  template <int dim>
  struct Location
  {
    LocalIndex        cell = invalid;
    Point<dim>        point;
    VertexValues<dim> lambda;
  };

  /// Finds the cell that contains a point; points outside of the mesh are moved to
  /// the nearest cell. On a lattice there is no search: the octree gives the leaf, the
  /// largest component of x - centre the face of the leaf over which the cell stands.
  template <int dim>
  class Locator
  {
  public:
    explicit Locator(const Mesh<dim> &mesh)
      : mesh(mesh)
    {}

    /// The cell is invalid if it is, or may be, one of another rank.
    Location<dim>
    locate(const Point<dim> &x) const;

    /// The cell of this rank, which is known to own the point.
    Location<dim>
    locate_here(const Point<dim> &x) const;

    struct Owner
    {
      unsigned int rank;
      Point<dim>   point; ///< in the mesh
    };

    /// Which ranks have the cells of these points? The same on whichever rank a point
    /// is asked for. Collective.
    std::vector<Owner>
    owners(const std::vector<Point<dim>> &x) const;

    /// Points moved into the mesh. Collective.
    std::vector<Point<dim>>
    clamped(const std::vector<Point<dim>> &x) const;

  private:
    Point<dim>
    moved_to_box(Point<dim> x) const;

    Location<dim>
    in_lattice(const Point<dim> &x) const;

    Location<dim>
    in_cell(const LocalIndex cell, const Point<dim> &x) const;

    /// The cell of the lowest number that contains x. With @p owned, of owned ones;
    /// else of all, but invalid if no owned one contains it: what does not touch the
    /// cells of this rank is only partly known here.
    Location<dim>
    in_tree(const Point<dim> &x, const bool owned) const;

    Location<dim>
    on_wall(const typename CellTree<dim>::Nearest &nearest) const;

    std::vector<Owner>
    owners_in_tree(const std::vector<Point<dim>> &x) const;

    const Mesh<dim>                &mesh;
    mutable std::vector<LocalIndex> candidates;
  };
} // namespace treacle

#endif
