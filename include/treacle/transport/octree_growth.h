// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_octree_growth_h
#define treacle_transport_octree_growth_h

#include <treacle/base/scattered.h>
#include <treacle/transport/bands.h>
#include <treacle/transport/sizing.h>

namespace treacle
{
  /// Grows octrees for one surface and time. Refers to parameters, sizing and scene; members are
  /// collective, and throw on all ranks alike what a formula throws on one.
  template <int dim>
  class OctreeGrowth
  {
  public:
    /// phi at any points, collectively.
    using LevelSet = std::function<std::vector<double>(const std::vector<Point<dim>> &)>;

    OctreeGrowth(const MPI_Comm              &comm,
                 const OctreeParameters<dim> &parameters,
                 const Sizing<dim>           &sizing,
                 const Scene<dim>            &scene,
                 const double                 time,
                 const LevelSet              &phi)
      : comm(comm)
      , prm(parameters)
      , sizing(sizing)
      , scene(scene)
      , time(time)
      , phi(phi)
    {}

    /// Refine where @p is_near says, inside the liquid to what is asked for there, and
    /// everywhere to the air level; every rank has about the same work with it. The octree remembers the
    /// factor with which its surface was asked (Octree::size_factor).
    std::shared_ptr<const Octree<dim>>
    grow(const typename Octree<dim>::Criterion &is_near, const double size_factor) const;

    /// The points that ask for leaves, which may be larger by a factor than what asks for them.
    using PointsByFactor = std::function<BandPoints<dim>(const double)>;

    /// One with bands around points, whose cubes are those of @p octree: with a factor, a power of 1.25, for which it is
    /// not full, but is for the next smaller one. It is looked for from that of @p octree on, with few others if it is near.
    std::shared_ptr<const Octree<dim>>
    grow_around(const Octree<dim> &octree, const PointsByFactor &points) const;

    /// With it all of the surface has leaves of its coarsest level; 1 if cells are not bounded.
    double
    largest_factor() const;

    /// Has it more than Maximum cells?
    bool
    is_full(const Octree<dim> &octree) const;

    /// Can leaves of the interior level be?
    bool
    may_be_too_coarse() const
    {
      return scene.has_solids() || sizing.asks_in_liquid(time);
    }

    /// Does any of these leaves, of any level, hold liquid, and is too coarse for what is asked for
    /// in it?
    bool
    is_any_too_coarse(const std::vector<Leaf<dim>> &leaves) const;

    /// The level set. Each rank asks for a leaf once, however many octrees have it.
    std::vector<double>
    phi_at_centres(const std::vector<Leaf<dim>> &leaves) const;

  private:
    /// Is more asked for at its centre? While leaves grow, what is asked for half an edge further,
    /// and in the middle of its children, counts too: the last leaves of a level are made when
    /// it was balanced, and are not asked.
    bool
    is_too_coarse(const Leaf<dim> &leaf, const bool while_growing) const;

    /// Of solids, where it is too large to show it.
    bool
    do_walls_bend(const Leaf<dim> &leaf, const bool while_growing) const;

    std::vector<bool>
    are_too_coarse(const std::vector<Leaf<dim>> &leaves,
                   const bool                    while_growing) const;

    /// Those in the liquid, of one level, that anything asks to refine.
    void
    refine_liquid(const std::vector<Leaf<dim>> &leaves, const unsigned int level, std::vector<bool> &refine) const;

    const MPI_Comm               comm;
    const OctreeParameters<dim> &prm;
    const Sizing<dim>           &sizing;
    const Scene<dim>            &scene;
    const double                 time;
    const LevelSet               phi;

    mutable std::unordered_map<VertexKey, double> known_phi; ///< at centres of leaves, in lattice units
  };

  /// Of leaves on all ranks, whatever rank each is on: the same for the same octree. Collective.
  template <int dim>
  std::uint64_t
  fingerprint(const Octree<dim> &octree)
  {
    std::uint64_t sum = 0;
    for (unsigned int l = 0; l < octree.n_owned_leaves(); ++l)
      {
        const Leaf<dim> &leaf = octree.leaves()[l];
        // mixed, or octrees that are mirror images of each other may have the same sum
        sum += mixed(mixed(pack<dim>(leaf.origin)) + leaf.level);
      }
    return Utilities::MPI::sum(sum, octree.communicator());
  }

  /// Leaves on all ranks. Collective.
  template <int dim>
  double
  n_leaves(const Octree<dim> &octree)
  {
    return Utilities::MPI::sum(1. * octree.n_owned_leaves(), octree.communicator());
  }
} // namespace treacle

#endif
