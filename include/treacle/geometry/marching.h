// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_marching_h
#define treacle_geometry_marching_h

#include <treacle/geometry/simplex.h>

namespace treacle
{
  /// A facet of the surface phi = 0 in a simplex: each of its dim vertices
  /// lies on the edge between two vertices of the simplex (first < second).
  template <int dim>
  using CutEdges = std::array<std::array<unsigned char, 2>, dim>;

  /// The facets of { phi = 0 } in a right-handed simplex: marching triangles
  /// or tetrahedra. A value of exactly zero counts as positive (air). Facets
  /// are ordered so that area_vector() points out of the liquid.
  template <int dim>
  struct Facets
  {
    std::array<CutEdges<dim>, 2> facet;
    unsigned int                 n = 0;
  };

  template <int dim>
  Facets<dim>
  surface_facets(const VertexValues<dim> &phi);

  /// Position of the zero on the edge from a to b, as a fraction of the edge.
  inline double
  edge_zero(const double phi_a, const double phi_b)
  {
    return phi_a / (phi_a - phi_b);
  }

  /// The vertices of a facet, with the position of each vertex of the simplex.
  template <int dim, typename Position>
  std::array<Point<dim>, dim>
  facet_points(const CutEdges<dim> &facet, const VertexValues<dim> &phi, const Position &position)
  {
    std::array<Point<dim>, dim> x;
    for (unsigned int i = 0; i < dim; ++i)
      {
        const auto [a, b]      = facet[i];
        const Point<dim> &from = position(a);
        x[i]                   = from + edge_zero(phi[a], phi[b]) * (position(b) - from);
      }
    return x;
  }
} // namespace treacle

#endif
