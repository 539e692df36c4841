// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_simplex_h
#define treacle_geometry_simplex_h

#include <treacle/base/types.h>

#include <numeric>

namespace treacle
{
  /// The vertices of a simplex, ordered so that signed_volume() is positive.
  template <int dim>
  using Simplex = std::array<Point<dim>, dim + 1>;

  /// One value per vertex of a simplex of dimension dim.
  template <int dim>
  using VertexValues = std::array<double, dim + 1>;

  /// The value at barycentric coordinates of what is linear between the vertices.
  template <std::size_t n>
  double
  interpolate(const std::array<double, n> &values, const std::array<double, n> &lambda)
  {
    return std::inner_product(values.begin(), values.end(), lambda.begin(), 0.);
  }

  /// The mean of the vertices.
  template <int dim>
  Point<dim>
  barycentre(const Simplex<dim> &x)
  {
    Point<dim> mean;
    for (const Point<dim> &vertex : x)
      mean += vertex / (dim + 1);
    return mean;
  }

  /// Volume (m^dim), positive for right-handed vertex order.
  template <int dim>
  double
  signed_volume(const Simplex<dim> &x);

  /// Gradients (1/m) of the P1 basis functions; they sum to zero.
  template <int dim>
  std::array<Tensor<1, dim>, dim + 1>
  basis_gradients(const Simplex<dim> &x);

  /// Barycentric coordinates of @p p; all are in [0,1] inside.
  template <int dim>
  VertexValues<dim>
  barycentric_coordinates(const Simplex<dim> &x, const Point<dim> &p)
  {
    const Tensor<1, dim> a = x[1] - x[0], b = x[2] - x[0], r = p - x[0];
    VertexValues<dim>    lambda;
    if constexpr (dim == 2)
      {
        const double scale = 1 / (a[0] * b[1] - a[1] * b[0]);
        lambda[1]          = scale * (r[0] * b[1] - r[1] * b[0]);
        lambda[2]          = scale * (a[0] * r[1] - a[1] * r[0]);
        lambda[0]          = 1 - lambda[1] - lambda[2];
      }
    else
      {
        const Tensor<1, dim> c = x[3] - x[0], bc = cross_product_3d(b, c), ra = cross_product_3d(r, a);
        const double         scale = 1 / (a * bc);
        lambda[1]                  = scale * (r * bc);
        lambda[2]                  = -scale * (ra * c);
        lambda[3]                  = scale * (ra * b);
        lambda[0]                  = 1 - lambda[1] - lambda[2] - lambda[3];
      }
    return lambda;
  }

  /// The dual centre o, `2 (x_i-x_0)·o = |x_i|^2 - w_i - |x_0|^2 + w_0`
  /// (w in m^2); without weights the circumcentre.
  template <int dim>
  Point<dim>
  weighted_circumcentre(const Simplex<dim> &x, const VertexValues<dim> &w);

  /// Area (m^(dim-1)) times unit normal of a facet given by its vertices, by
  /// the right-hand rule (2D: the direction from vertex 0 to 1 turned clockwise,
  /// so that a counter-clockwise boundary has outward normals).
  template <int dim>
  Tensor<1, dim>
  area_vector(const std::array<Point<dim>, dim> &x);
} // namespace treacle

#endif
