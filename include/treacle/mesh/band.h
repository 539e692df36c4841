// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_band_h
#define treacle_mesh_band_h

#include <treacle/mesh/octree.h>

namespace treacle
{
  /// The finest cubes of the octree's lattice within some layers of a set of points,
  /// on all ranks together.
  template <int dim>
  class Band
  {
  public:
    /// @p points of this rank; @p width in finest leaves.
    Band(const Octree<dim> &octree, const std::vector<Point<dim>> &points, const unsigned int width);

    /// Is every cube a leaf of the finest level? Collective.
    bool
    is_finest_in(const Octree<dim> &octree) const;

    /// Which of these leaves, all of one level, hold a cube of any rank? Collective.
    std::vector<bool>
    touches(const std::vector<Leaf<dim>> &leaves) const;

  private:
    MPI_Comm                       comm;
    unsigned int                   finest_level;
    std::vector<LatticePoint<dim>> cubes; ///< lowest corners, sorted
  };
} // namespace treacle

#endif
