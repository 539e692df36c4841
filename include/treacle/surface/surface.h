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
      return facet_points(facet, positions);
    }

    /// Where its vertices are elsewhere.
    std::array<Point<dim>, dim>
    facet_points(const unsigned int facet, const std::vector<Point<dim>> &elsewhere) const
    {
      std::array<Point<dim>, dim> x;
      for (unsigned int i = 0; i < dim; ++i)
        x[i] = elsewhere[facets[facet][i]];
      return x;
    }
  };

  /// @p phi must have up-to-date ghosts.
  template <int dim>
  Surface<dim>
  extract_surface(const Mesh<dim> &mesh, const Vector &phi);

  /// Does the surface pass through a cell?
  template <int dim>
  bool
  is_cut(const Mesh<dim> &mesh, const Vector &phi, const LocalIndex cell)
  {
    unsigned int n_negative = 0;
    for (const LocalIndex node : mesh.cell_nodes[cell])
      n_negative += phi.local_element(node) < 0;
    return n_negative > 0 && n_negative <= dim;
  }

  /// Call @p visit with the vertices of each facet of phi = 0 in a cell.
  template <int dim, typename Visit>
  void
  for_each_facet(const Mesh<dim>  &mesh,
                 const Vector     &phi,
                 const LocalIndex  cell,
                 const Visit      &visit)
  {
    if (!is_cut(mesh, phi, cell))
      return;
    const VertexValues<dim> values = mesh.values(cell, phi);
    const Facets<dim>       facets = surface_facets<dim>(values);
    for (unsigned int k = 0; k < facets.n; ++k)
      visit(facet_points<dim>(facets.facet[k], values, [&](const unsigned int v) -> const Point<dim> & {
        return mesh.node_position[mesh.cell_nodes[cell][v]];
      }));
  }
} // namespace treacle

#endif
