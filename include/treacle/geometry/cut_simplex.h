// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_cut_simplex_h
#define treacle_geometry_cut_simplex_h

#include <treacle/geometry/simplex.h>

namespace treacle
{
  /// Fraction of a simplex of dimension dim (1, 2 or 3) on which the P1
  /// function with vertex values @p phi is negative. Exact.
  template <int dim>
  double
  negative_fraction(const VertexValues<dim> &phi);

  /// Centroid of the part of a facet on which the P1 function with vertex values
  /// @p phi is negative; of the whole facet if that is none. Exact.
  template <int dim>
  Point<dim>
  negative_centroid(const std::array<Point<dim>, dim> &x, const VertexValues<dim - 1> &phi);

  /// A vertex i of a simplex, or (j other than i) the cut of the edge from i, where a
  /// function is negative, to j, where it is not.
  struct Corner
  {
    unsigned char i, j;
  };

  /// Up to three simplices.
  template <int dim>
  struct Parts
  {
    std::array<std::array<Corner, dim + 1>, 3> corners;
    unsigned int                               n = 0;
  };

  /// The part of the simplex on which the P1 function with vertex values @p phi is
  /// negative. Of two negative vertices the one that comes first in @p order is not
  /// cut off from the other's cuts: with the same order in all simplices of a mesh
  /// their parts meet.
  template <int dim>
  Parts<dim>
  negative_parts(const VertexValues<dim>                   &phi,
                 const std::array<unsigned int, dim + 1> &order);

  /// Volume (m^dim) and first moment (integral of x, m^(dim+1)) of a set.
  template <int dim>
  struct Moments
  {
    double         volume = 0;
    Tensor<1, dim> first;
  };

  /// Moments of { phi < 0 and psi > 0 } inside the simplex, both P1: the
  /// liquid outside a solid. Exact.
  template <int dim>
  Moments<dim>
  liquid_moments(const Simplex<dim>      &x,
                 const VertexValues<dim> &phi,
                 const VertexValues<dim> &psi);
} // namespace treacle

#endif
