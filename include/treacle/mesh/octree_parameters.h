// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_octree_parameters_h
#define treacle_mesh_octree_parameters_h

#include <treacle/base/types.h>

#include <deal.II/base/parameter_handler.h>

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
    unsigned int interior_level = 4;
    unsigned int air_level      = 3;
    unsigned int band_width     = 3;
    unsigned int air_band_width = 1;

    /// Throws a UserError where no octree fits.
    void
    check() const;

    /// Edge of a leaf of the surface level (m).
    double
    finest_size() const;

    /// Root cubes along each axis. Throws a UserError where cubes cannot tile the box.
    std::vector<unsigned int>
    root_counts() const;

    /// Subsection Mesh; the corners belong to the Scene.
    void
    add_parameters(ParameterHandler &prm);

  private:
    double
    shortest_edge() const;
  };
} // namespace treacle

#endif
