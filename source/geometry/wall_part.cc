// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/cut_simplex.h>
#include <treacle/geometry/marching.h>
#include <treacle/geometry/wall_part.h>

#include <algorithm>

namespace treacle
{
  template <int dim>
  WallPart<dim>
  wall_part(const std::array<Point<dim>, dim> &x, const VertexValues<dim - 1> &phi)
  {
    return {negative_fraction<dim - 1>(phi) * area_vector<dim>(x), negative_centroid<dim>(x, phi)};
  }

  template <int dim>
  WallPart<dim>
  wall_part(const Simplex<dim> &x, const VertexValues<dim> &depth, const VertexValues<dim> &phi)
  {
    Tensor<1, dim>    area, moment;
    const Facets<dim> facets   = surface_facets<dim>(depth);
    const auto        position = [&](const unsigned int i) -> const Point<dim> & { return x[i]; };
    for (unsigned int k = 0; k < facets.n; ++k)
      {
        VertexValues<dim - 1> at_corners;
        std::transform(facets.facet[k].begin(), facets.facet[k].end(), at_corners.begin(), [&](const auto &edge) {
          const auto [a, b] = edge;
          return phi[a] + edge_zero(depth[a], depth[b]) * (phi[b] - phi[a]);
        });
        const WallPart<dim> part = wall_part<dim>(facet_points<dim>(facets.facet[k], depth, position), at_corners);
        area += part.area;
        moment += part.area.norm() * part.centre;
      }
    return {area, Point<dim>(area.norm() > 0 ? moment / area.norm() : moment)};
  }

#define INSTANTIATE(dim)                                                                             \
  template WallPart<dim> wall_part<dim>(const std::array<Point<dim>, dim> &, const VertexValues<dim - 1> &); \
  template WallPart<dim> wall_part<dim>(const Simplex<dim> &, const VertexValues<dim> &, const VertexValues<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
