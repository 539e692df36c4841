// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_bands_h
#define treacle_transport_bands_h

#include <treacle/mesh/band.h>
#include <treacle/scene/scene.h>
#include <treacle/surface/surface.h>

#include <map>

namespace treacle
{
  /// What a band of each level is laid around.
  template <int dim>
  using BandPoints = std::map<unsigned int, std::vector<BandPoint<dim>>>;

  /// Add a facet's corners and centre, with its normal.
  template <int dim>
  void
  append(std::vector<BandPoint<dim>> &points, const std::array<Point<dim>, dim> &facet);

  /// The facets of a surface with their vertices at @p x, each at the largest of the levels that its
  /// vertices ask for.
  template <int dim>
  BandPoints<dim>
  facets_by_level(const Surface<dim>              &surface,
                  const std::vector<Point<dim>>   &x,
                  const std::vector<unsigned int> &level);

  /// Centre of a leaf of an octree that is still growing.
  template <int dim>
  Point<dim>
  centre(const OctreeParameters<dim> &prm, const Leaf<dim> &leaf);

  /// Vertex i (bit d: upper along axis d) of a cube.
  template <int dim>
  Point<dim>
  vertex_of_cube(Point<dim> centre, const double edge, const unsigned int i)
  {
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] += (i >> d & 1 ? 0.5 : -0.5) * edge;
    return centre;
  }

  /// Half the diagonal of a cube.
  template <int dim>
  double
  half_diagonal(const double edge)
  {
    return 0.5 * std::sqrt(1. * dim) * edge;
  }

  /// Is such a leaf within @p margin (m) of where a distance, known at its centre, vanishes?
  template <int dim>
  bool
  is_within(const OctreeParameters<dim> &prm,
            const Leaf<dim>             &leaf,
            const double                 distance,
            const double                 margin)
  {
    return std::abs(distance) < half_diagonal<dim>(prm.size_of(leaf.level)) + margin;
  }

  /// The bands of all levels that the surface may have, and finest leaves around emitters. Refers to
  /// octree and scene.
  template <int dim>
  class Bands
  {
  public:
    /// @p points of this rank; nothing but the cubes that touch them if @p narrow. Throws on all ranks
    /// alike. Collective.
    Bands(const Octree<dim>     &octree,
          const Scene<dim>      &scene,
          const double           time,
          const BandPoints<dim> &points,
          const bool             narrow);

    /// Are the octree's leaves as fine as they ask for, but for so many cubes that hold none of the
    /// points? Collective.
    bool
    are_in_leaves(const double most_missing = 0) const;

    /// Which of these leaves, all of one level, are to be finer? Collective.
    std::vector<bool>
    touch(const std::vector<Leaf<dim>> &leaves) const;

  private:
    const Octree<dim>          &octree;
    const OctreeParameters<dim> prm;
    const Scene<dim>           &scene;
    const double                time;
    std::vector<Band<dim>>      bands; ///< from the coarsest level on
  };
} // namespace treacle

#endif
