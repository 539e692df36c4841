// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_near_ranks_h
#define treacle_mesh_near_ranks_h

#include <treacle/mesh/locator.h>

namespace treacle
{
  /// Which other ranks have cells within a margin of a box (or a few more).
  template <int dim>
  class NearRanks
  {
  public:
    /// Collective. @p margin in m.
    NearRanks(const Mesh<dim> &mesh, const double margin)
      : rank(Utilities::MPI::this_mpi_process(mesh.communicator()))
    {
      std::vector<BoundingBox<dim>> mine = mesh.locator().covering_boxes();
      for (BoundingBox<dim> &box : mine)
        box.extend(margin);
      boxes = Utilities::MPI::all_gather(mesh.communicator(), mine);
    }

    /// Call @p visit with each other rank that may have a cell near @p around.
    template <typename Visit>
    void
    for_each(const BoundingBox<dim> &around, const Visit &visit) const
    {
      for (unsigned int r = 0; r < boxes.size(); ++r)
        if (r != rank && std::any_of(boxes[r].begin(), boxes[r].end(), [&](const auto &other) {
              return other.get_neighbor_type(around) != NeighborType::not_neighbors;
            }))
          visit(r);
    }

    unsigned int
    n_ranks() const
    {
      return boxes.size();
    }

  private:
    const unsigned int                         rank;
    std::vector<std::vector<BoundingBox<dim>>> boxes; ///< of each rank's cells
  };
} // namespace treacle

#endif
