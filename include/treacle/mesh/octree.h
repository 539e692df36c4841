// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_octree_h
#define treacle_mesh_octree_h

#include <treacle/base/types.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/distributed/tria.h>

#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

namespace treacle
{
  /// Integer coordinates on the finest lattice: units of half a finest leaf.
  template <int dim>
  using LatticePoint = std::array<int, dim>;

  /// Pack lattice coordinates (21 bits each) into a key.
  template <int dim>
  inline VertexKey
  pack(const LatticePoint<dim> &p)
  {
    VertexKey key = 0;
    for (unsigned int d = 0; d < dim; ++d)
      key = (key << 21) | static_cast<VertexKey>(p[d]);
    return key;
  }

  template <int dim>
  inline LatticePoint<dim>
  unpack(VertexKey key)
  {
    LatticePoint<dim> p;
    for (int d = dim - 1; d >= 0; --d, key >>= 21)
      p[d] = static_cast<int>(key & ((1u << 21) - 1));
    return p;
  }

  /// A leaf of the octree: its lowest corner and edge in lattice units.
  template <int dim>
  struct Leaf
  {
    LatticePoint<dim> origin;
    int               size;
    unsigned int      level;

    LatticePoint<dim>
    centre() const
    {
      LatticePoint<dim> c = origin;
      for (auto &x : c)
        x += size / 2;
      return c;
    }
  };

  /// The face, edge or corner neighbour of the same size as a known leaf.
  enum class Neighbour
  {
    outside,
    same,
    finer,
    coarser
  };

  /// A balanced (2:1 over faces, edges and corners), partitioned octree on a box.
  template <int dim>
  class Octree
  {
  public:
    struct Parameters
    {
      Point<dim>   lower_corner;
      Point<dim>   upper_corner;
      unsigned int root_cells    = 1;
      unsigned int surface_level = 6;
      unsigned int interior_level = 4;
      unsigned int air_level      = 3;
      unsigned int band_width     = 3;

      /// Throws a UserError where no octree fits.
      void
      check() const;

      /// Edge of a leaf of the surface level (m).
      double
      finest_size() const;

      /// Subsection Mesh; the corners belong to the Scene.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// Which of these leaves, all of one level, are to be refined? Collective.
    using Criterion =
      std::function<std::vector<bool>(const std::vector<Leaf<dim>> &)>;

    /// Refine level by level from the root cells, balance, and partition so
    /// that every rank has about the same sum of @p weight (at least 1).
    /// Throws a UserError where cubes cannot tile the box.
    Octree(const MPI_Comm                                &comm,
           const Parameters                              &parameters,
           const Criterion                               &criterion,
           const std::function<unsigned int(const Leaf<dim> &)> &weight);

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
      return n_owned;
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

    /// The rank whose leaf contains x (clamped to the box), for each x.
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
    void
    collect_leaves();

    MPI_Comm   comm;
    Parameters prm;
    /// mutable: the look-up of owners is not const in deal.II.
    mutable parallel::distributed::Triangulation<dim> triangulation;

    LatticePoint<dim>                           box;
    double                                      unit;
    std::vector<Leaf<dim>>                      all_leaves;
    unsigned int                                n_owned = 0;
    std::unordered_map<VertexKey, unsigned int> by_origin;
  };
} // namespace treacle

#endif
