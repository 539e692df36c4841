// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_surface_h
#define treacle_surface_surface_h

#include <treacle/fields/state.h>
#include <treacle/geometry/marching.h>

namespace treacle
{
  /// The surface phi = 0 in the cells of this rank: segments in 2D, triangles
  /// in 3D, oriented so that area_vector() points out of the liquid.
  template <int dim>
  struct Surface
  {
    /// A vertex on the edge from node a to node b (local indices; the key of a
    /// is smaller), at the fraction t of it.
    struct Vertex
    {
      LocalIndex a, b;
      double     t;
    };

    std::vector<Vertex>                       vertices; ///< each once on this rank
    std::vector<Point<dim>>                   positions; ///< of the vertices (m)
    std::vector<std::array<unsigned int, dim>> facets;  ///< vertex indices

    std::array<Point<dim>, dim>
    facet_points(const unsigned int facet) const
    {
      std::array<Point<dim>, dim> x;
      for (unsigned int i = 0; i < dim; ++i)
        x[i] = positions[facets[facet][i]];
      return x;
    }
  };

  /// @p phi must have up-to-date ghosts.
  template <int dim>
  Surface<dim>
  extract_surface(const Mesh<dim> &mesh, const Vector &phi);
} // namespace treacle

#endif
