// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_near_ranks_h
#define treacle_mesh_near_ranks_h

#include <treacle/mesh/cube_grid.h>

namespace treacle
{
  /// Which other ranks have cells within a margin of a box (or a few more: all that lies in
  /// one cube of a leaf, or a quarter of the margin, has the same).
  template <int dim>
  class NearRanks
  {
  public:
    /// @p margin in m.
    NearRanks(const Mesh<dim> &mesh, const double margin);

    /// Call @p visit with each other rank that may have a cell near the box between two corners.
    template <typename Visit>
    void
    for_each(const Point<dim> &lower, const Point<dim> &upper, const Visit &visit) const
    {
      if (n_ranks() == 1)
        return;
      std::vector<unsigned int> visited;
      grid.for_each(lower, upper, [&](const LatticePoint<dim> &cube) {
        for (const unsigned int r : near(cube))
          if (std::find(visited.begin(), visited.end(), r) == visited.end())
            {
              visited.push_back(r);
              visit(r);
            }
      });
    }

    unsigned int
    n_ranks() const
    {
      return boxes.size();
    }

  private:
    const std::vector<unsigned int> &
    near(const LatticePoint<dim> &cube) const;

    const unsigned int                                               rank;
    const CubeGrid<dim>                                              grid;
    const double                                                     margin;
    const std::vector<std::vector<BoundingBox<dim>>>                &boxes; ///< of each rank's cells
    mutable std::unordered_map<VertexKey, std::vector<unsigned int>> known; ///< by cube
  };
} // namespace treacle

#endif
