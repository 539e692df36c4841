// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_surface_distance_h
#define treacle_surface_surface_distance_h

#include <treacle/geometry/facet_tree.h>
#include <treacle/surface/surface.h>

#include <deal.II/base/bounding_box.h>

namespace treacle
{
  /// Nearest points on the surface phi = 0 of all ranks, within a given reach.
  /// Where the surface ends on the box it goes on beyond it as a plane, so that
  /// the distance from a flat surface is linear at a wall too.
  template <int dim>
  class SurfaceDistance
  {
  public:
    /// @p surface in the cells of this rank. Where the @p solid_distance at their nodes is given, no facet in a solid lies along a side of
    /// the box: what phi shows there need not be a surface. Collective: each rank receives the facets within @p reach (m) of its leaves.
    SurfaceDistance(const Mesh<dim>           &mesh,
                    const Surface<dim>        &surface,
                    const double               reach,
                    const std::vector<double> &solid_distance = {});

    struct Nearest
    {
      Point<dim> point;    ///< in the box
      double     distance; ///< m, not signed; infinite if beyond the reach
    };

    /// Of points that are as near the one of smallest coordinates, whatever the partition. An
    /// @p expected distance (m) of about the right size saves work.
    Nearest
    nearest(const Point<dim> &x,
            const double      expected = std::numeric_limits<double>::infinity()) const;

    /// Is any facet within a distance (m), at most the reach?
    bool
    is_any_within(const Point<dim> &x, const double distance) const;

    const double reach;

  private:
    using Facet = std::array<Point<dim>, dim>;

    /// Append those of this rank and of others.
    void
    gather_facets(const Mesh<dim> &mesh, const Surface<dim> &surface, const std::vector<double> &solid_distance);

    /// A facet, and its point that is nearest.
    struct Candidate
    {
      Point<dim>   point;
      double       distance;
      unsigned int facet;
    };

    /// Those of all facets that are as near as any closer than @p within (m), into candidates.
    /// Returns false if there are none, or others that are as near may lie just beyond.
    bool
    find_near(const Point<dim> &x, const double within) const;

    double
    distance_beyond_box(const Point<dim> &x, const Candidate &candidate) const;

    const BoundingBox<dim> box;
    const double           tolerance; ///< of distances and coordinates that are the same (m)

    std::vector<Facet> facets;
    std::vector<bool>  in_solid; ///< a facet
    FacetTree<dim>     tree;

    mutable std::vector<Candidate> candidates; ///< scratch
  };
} // namespace treacle

#endif
