// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_locator_h
#define treacle_mesh_locator_h

#include <treacle/base/work.h>
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

    double
    smallest_coordinate() const
    {
      return *std::min_element(lambda.begin(), lambda.end());
    }
  };

  /// Finds the cell that contains a point; points outside of the mesh are moved to
  /// the nearest cell.
  template <int dim>
  class Locator
  {
  public:
    /// @p covering: boxes around the cells that this rank owns, or whose leaves it does. Collective.
    Locator(const Mesh<dim> &mesh, const std::vector<BoundingBox<dim>> &covering)
      : mesh(mesh)
      , neighbours(mesh.cell_faces)
      , boxes(Utilities::MPI::all_gather(mesh.communicator(), covering))
    {
      for (LocalIndex cell = 0; cell < neighbours.size(); ++cell)
        for (LocalIndex &k : neighbours[cell])
          {
            const auto &sides = mesh.face_cells[k];
            k                 = sides[sides[0] == cell];
          }
    }

    Locator(const Locator &) = delete;

    virtual ~Locator() = default;

    /// The cell is invalid if it is, or may be, one of another rank.
    virtual Location<dim>
    locate(const Point<dim> &x) const = 0;

    /// The same, by a walk from cell to cell that begins at @p guess, which may be invalid.
    Location<dim>
    locate(const Point<dim> &x, const LocalIndex guess) const
    {
      const Location<dim> location = walk(x, guess);
      return location.cell == invalid ? locate(x) : location;
    }

    /// The cell of this rank, which is known to own the point.
    virtual Location<dim>
    locate_here(const Point<dim> &x) const = 0;

    Location<dim>
    locate_here(const Point<dim> &x, const LocalIndex guess) const
    {
      const Location<dim> location = walk(x, guess);
      return location.cell == invalid ? locate_here(x) : location;
    }

    struct Owner
    {
      unsigned int rank;
      Point<dim>   point; ///< in the mesh
    };

    /// Which ranks have the cells of these points? The same on whichever rank a point
    /// is asked for. Collective.
    virtual std::vector<Owner>
    owners(const std::vector<Point<dim>> &x) const = 0;

    /// The same of points that locate() did not find here, which need not be looked for again. Collective.
    virtual std::vector<Owner>
    owners_elsewhere(const std::vector<Point<dim>> &x) const
    {
      return owners(x);
    }

    /// Points moved into the mesh. Collective.
    virtual std::vector<Point<dim>>
    clamped(const std::vector<Point<dim>> &x) const = 0;

    /// Boxes that cover the cells of each rank.
    const std::vector<std::vector<BoundingBox<dim>>> &
    rank_boxes() const
    {
      return boxes;
    }

  protected:
    Point<dim>
    moved_to_box(Point<dim> x) const
    {
      const BoundingBox<dim> &box = mesh.box();
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = std::min(std::max(x[d], box.lower_bound(d)), box.upper_bound(d));
      return x;
    }

    Location<dim>
    in_cell(const LocalIndex cell, const Point<dim> &x) const
    {
      // gradients would be at hand, but in 3D there are five times as many cells as nodes, and what counts here is memory
      return {cell, x, barycentric_coordinates<dim>(mesh.cell_vertices(cell), x)};
    }

    const Mesh<dim>                &mesh;
    mutable std::vector<LocalIndex> candidates;

  private:
    /// Not found, or found in an owned cell.
    Location<dim>
    walk(const Point<dim> &x, LocalIndex cell) const
    {
      ++Work::here().points_located;
      constexpr unsigned int longest = 12;
      for (unsigned int k = 0; k < longest && cell < mesh.n_owned_cells(); ++k)
        {
          const Location<dim> location = in_cell(cell, x);
          const auto          least    = std::min_element(location.lambda.begin(), location.lambda.end());
          if (*least > -1e-12)
            return location;
          cell = neighbours[cell][least - location.lambda.begin()];
        }
      return {};
    }

    /// Of each cell, opposite its nodes; invalid on the box, and beyond the ghost layer.
    std::vector<std::array<LocalIndex, dim + 1>>     neighbours;
    const std::vector<std::vector<BoundingBox<dim>>> boxes; ///< of ranks
  };
} // namespace treacle

#endif
