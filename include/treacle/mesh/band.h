// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_band_h
#define treacle_mesh_band_h

#include <treacle/mesh/octree.h>

namespace treacle
{
  /// A point to lay a band around: of a surface with its unit normal out of the liquid, or
  /// any other, with zero.
  template <int dim>
  struct BandPoint
  {
    Point<dim>     position;
    Tensor<1, dim> outward;
  };

  /// How far a band goes, between the centres of cubes, in their edges.
  struct BandWidths
  {
    double inner = 0; ///< against the normal
    double outer = 0; ///< along it
  };

  /// The cubes of one level around a set of points, on all ranks together: those that touch the
  /// cube of a point, and those within its widths.
  template <int dim>
  class Band
  {
  public:
    /// @p points of this rank; only cubes whose centres @p is_needed. Collective; throws on all
    /// ranks alike what that throws on one.
    Band(const Octree<dim>                             &octree,
         const unsigned int                             level,
         const std::vector<BandPoint<dim>>             &points,
         const BandWidths                              &widths,
         const std::function<bool(const Point<dim> &)> &is_needed);

    /// Cubes that lie in larger leaves.
    struct Missing
    {
      GlobalIndex at_points, in_all;
    };

    /// Each counted once, whatever the partition. Collective.
    Missing
    missing_in(const Octree<dim> &octree) const;

    /// Which of these leaves, all of one level, hold smaller cubes of any rank? Collective.
    std::vector<bool>
    touches(const std::vector<Leaf<dim>> &leaves) const;

  private:
    /// Those @p list that lie in larger leaves. Collective.
    GlobalIndex
    n_in_larger_leaves(const Octree<dim> &octree, const std::vector<VertexKey> &list) const;

    MPI_Comm               comm;
    int                    root; ///< edge of a root cube, in lattice units
    int                    size; ///< of a cube
    std::vector<VertexKey> cubes, at_points; ///< lowest corners, sorted
  };
} // namespace treacle

#endif
