// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_octree_h
#define treacle_mesh_octree_h

#include <treacle/mesh/octree_parameters.h>
#include <treacle/mesh/tree_order.h>

#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

namespace treacle
{
  template <int dim>
  class Forest;

  /// A balanced (2:1 over faces, edges and corners), partitioned octree on a box.
  template <int dim>
  class Octree
  {
  public:
    using Parameters = OctreeParameters<dim>;

    /// Which of these leaves, all of one level, are to be refined? Collective.
    using Criterion = std::function<std::vector<bool>(const std::vector<Leaf<dim>> &)>;

    /// The work that each of these leaves makes, in units of one's choice (at least 1).
    /// Collective.
    using Weight = std::function<std::vector<unsigned int>(const std::vector<Leaf<dim>> &)>;

    /// Refine level by level from the root cells, balance, and partition so
    /// that every rank has about the same sum of @p weight.
    /// Throws a UserError where cubes cannot tile the box.
    Octree(const MPI_Comm   &comm,
           const Parameters &parameters,
           const Criterion  &criterion,
           const Weight     &weight      = &alike,
           const double      size_factor = 1);

    const MPI_Comm &
    communicator() const
    {
      return comm;
    }

    const Parameters &
    parameters() const
    {
      return prm;
    }

    /// Leaves of this rank along the space filling curve, then ghost leaves
    /// (all that share a corner with an owned one).
    const std::vector<Leaf<dim>> &
    leaves() const
    {
      return all_leaves;
    }

    unsigned int
    n_owned_leaves() const
    {
      return weights.size();
    }

    /// Edge of a root cube in lattice units.
    int
    root_size() const
    {
      return 2 << prm.surface_level;
    }

    /// By how much the leaves along the surface may be larger than it asks for, lest there are more than Maximum cells;
    /// others may give the same leaves.
    double
    size_factor() const
    {
      return factor;
    }

    /// What the partition weighed the owned leaves by.
    const std::vector<unsigned int> &
    leaf_weights() const
    {
      return weights;
    }

    /// The known leaf with its lowest corner at @p origin, or invalid.
    LocalIndex
    leaf_at(const LatticePoint<dim> &origin) const;

    /// What stands at @p offset (each -1, 0 or 1) times its size from an owned leaf.
    Neighbour
    neighbour(const Leaf<dim> &leaf, const LatticePoint<dim> &offset) const;

    /// The known leaf that contains x (clamped to the box), or invalid.
    LocalIndex
    leaf_containing(const Point<dim> &x) const;

    /// The rank whose leaf contains x (clamped to the box), for each x. Not collective.
    std::vector<unsigned int>
    owner_ranks(const std::vector<Point<dim>> &x) const;

    /// Upper end of the box in lattice units.
    const LatticePoint<dim> &
    extent() const
    {
      return box;
    }

    Point<dim>
    position(const LatticePoint<dim> &p) const;

    /// The finest cube (its lowest corner) that contains x, clamped to the box.
    LatticePoint<dim>
    finest_cube(const Point<dim> &x) const;

    /// Edge of a leaf (m).
    double
    size(const Leaf<dim> &leaf) const
    {
      return leaf.size * unit;
    }

    /// Edge of a finest leaf (m).
    double
    finest_size() const
    {
      return 2 * unit;
    }

  private:
    static std::vector<unsigned int>
    alike(const std::vector<Leaf<dim>> &leaves)
    {
      return std::vector<unsigned int>(leaves.size(), 1);
    }

    /// A tree of p4est's forest, and the place along the Morton curve in it.
    using Position = std::pair<unsigned int, std::uint64_t>;

    /// Of the finest cube with this lowest corner: it orders all leaves.
    Position
    position_on_curve(const LatticePoint<dim> &cube) const;

    void
    refine(Forest<dim> &forest, const Criterion &criterion) const;

    void
    collect_leaves(const Forest<dim> &forest);

    void
    find_ranges();

    MPI_Comm       comm;
    Parameters     prm;
    TreeOrder<dim> order;

    LatticePoint<dim>                           box;
    double                                      unit;
    double                                      factor;
    std::vector<Leaf<dim>>                      all_leaves;
    std::vector<unsigned int>                   weights;
    std::unordered_map<VertexKey, unsigned int> by_origin;
    /// Where the leaves of each rank begin on the curve; those of one without any, where the
    /// next one's do.
    std::vector<Position> first_of_rank;
  };
} // namespace treacle

#endif
