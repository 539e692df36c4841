// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_locator_h
#define treacle_mesh_locator_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// A cell, and the barycentric coordinates of a point in it.
  template <int dim>
  struct Location
  {
    LocalIndex        cell = invalid;
    VertexValues<dim> lambda;
  };

  /// Finds the cell that contains a point, without a search: the octree gives
  /// the leaf, the largest component of x - centre the face of the leaf over
  /// which the cell stands.
  template <int dim>
  class Locator
  {
  public:
    explicit Locator(const Mesh<dim> &mesh)
      : mesh(mesh)
    {}

    /// Points beyond the box are moved to it first. The cell is invalid if
    /// another rank owns the leaf that contains @p x.
    Location<dim>
    locate(const Point<dim> &x) const;

    Point<dim>
    clamped(Point<dim> x) const;

  private:
    const Mesh<dim>                &mesh;
    mutable std::vector<LocalIndex> candidates;
  };
} // namespace treacle

#endif
