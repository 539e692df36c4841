// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_octree_parameters_h
#define treacle_mesh_octree_parameters_h

#include <treacle/base/types.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <string>
#include <vector>

namespace treacle
{
  /// The box of an octree, its root cubes, and the levels of its leaves.
  template <int dim>
  struct OctreeParameters
  {
    Point<dim>   lower_corner;
    Point<dim>   upper_corner;
    unsigned int root_cells     = 1;
    unsigned int surface_level  = 6;
    unsigned int coarsest_surface_level = 18; ///< if less than the surface level
    unsigned int interior_level = 4;
    unsigned int air_level      = 3;
    unsigned int band_width     = 3;
    unsigned int air_band_width = 1;

    // what asks for finer leaves along the surface than the coarsest
    double      leaves_per_radius = 4; ///< of curvature
    double      leaves_across     = 4; ///< liquid and gaps
    std::string size;                  ///< of leaves (m), a formula; empty: any
    bool        fine_at_jumps = false; ///< of the material
    double      velocity_error = 0; ///< of the largest speed; 0: any
    unsigned int maximum_cells = 0;    ///< about; 0: any number

    /// Throws a UserError where no octree fits.
    void
    check() const;

    /// Edge of a leaf of the surface level (m).
    double
    finest_size() const;

    /// Smallest level of leaves that the surface passes through.
    unsigned int
    coarsest_at_surface() const
    {
      return std::min(coarsest_surface_level, surface_level);
    }

    /// Edge of a leaf (m).
    double
    size_of(const unsigned int level) const
    {
      return std::ldexp(finest_size(), static_cast<int>(surface_level) - static_cast<int>(level));
    }

    /// The finest level that curvature and Size ask for along the surface: with Maximum cells two beyond its own, so
    /// that what is sharper becomes coarse last, but edges and creases not at the cost of all else.
    unsigned int
    level_asked() const
    {
      return surface_level + (maximum_cells > 0 ? 2 : 0);
    }

    /// The cells that stand on so many leaves, about.
    static double
    n_cells(const double n_leaves)
    {
      return (dim == 2 ? 4 : 12) * n_leaves;
    }

    /// The smallest level whose leaves are no larger than @p size (m), up to the surface level.
    unsigned int
    level_of(const double size) const;

    /// Root cubes along each axis. Throws a UserError where cubes cannot tile the box.
    std::vector<unsigned int>
    root_counts() const;

    /// Subsection Mesh; the corners belong to the Scene.
    void
    add_parameters(ParameterHandler &prm);

  private:
    /// What makes leaves finer than they must be.
    void
    add_sizes(ParameterHandler &prm);

    double
    shortest_edge() const;
  };
} // namespace treacle

#endif
