// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/cut_simplex.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace treacle
{
  namespace
  {
    /// A simplex that carries the second function while the first one cuts it.
    template <int dim>
    struct Piece
    {
      Simplex<dim>      x;
      VertexValues<dim> psi;
    };

    template <int dim>
    struct Pieces
    {
      std::array<Piece<dim>, 3> piece;
      unsigned int              n = 0;
    };

    /// Vertices with negative values first, else as they are; returns how many there are.
    template <int dim>
    unsigned int
    negative_first(const VertexValues<dim> &phi, std::array<unsigned int, dim + 1> &order)
    {
      std::array<unsigned int, dim + 1> others;
      unsigned int                      n = 0, n_others = 0;
      for (const unsigned int i : order)
        (phi[i] < 0 ? order[n++] : others[n_others++]) = i;
      std::copy_n(others.begin(), n_others, order.begin() + n);
      return n;
    }

    template <int dim>
    std::array<unsigned int, dim + 1>
    as_they_are()
    {
      std::array<unsigned int, dim + 1> order;
      std::iota(order.begin(), order.end(), 0);
      return order;
    }

    template <int dim>
    using Corners = std::array<std::array<Corner, dim + 1>, 3>;

    /// The negative part as simplices (entry k: k+1 negative vertices), for
    /// negative vertices first. In 3D two or three negative
    /// vertices leave a prism.
    template <int dim>
    constexpr std::array<Corners<dim>, dim> negative_pieces;

    template <>
    constexpr std::array<Corners<2>, 2> negative_pieces<2> = {
      {{{{{{0, 0}, {0, 1}, {0, 2}}}}},
       {{{{{0, 0}, {1, 1}, {1, 2}}}, {{{0, 0}, {1, 2}, {0, 2}}}}}}};

    template <>
    constexpr std::array<Corners<3>, 3> negative_pieces<3> = {
      {{{{{{0, 0}, {0, 1}, {0, 2}, {0, 3}}}}},
       {{{{{0, 0}, {0, 2}, {0, 3}, {1, 3}}},
         {{{0, 0}, {0, 2}, {1, 2}, {1, 3}}},
         {{{0, 0}, {1, 1}, {1, 2}, {1, 3}}}}},
       {{{{{0, 0}, {1, 1}, {2, 2}, {2, 3}}},
         {{{0, 0}, {1, 1}, {1, 3}, {2, 3}}},
         {{{0, 0}, {0, 3}, {1, 3}, {2, 3}}}}}}};

  } // namespace

  template <int dim>
  Parts<dim>
  negative_parts(const VertexValues<dim>                   &phi,
                 const std::array<unsigned int, dim + 1> &order)
  {
    std::array<unsigned int, dim + 1> sorted = order;
    const unsigned int                n_negative = negative_first<dim>(phi, sorted);

    Parts<dim> result;
    if (n_negative == 0)
      return result;
    result.n = n_negative == 1 || n_negative == dim + 1 ? 1 : dim;
    for (unsigned int k = 0; k < result.n; ++k)
      for (unsigned char v = 0; v <= dim; ++v)
        {
          const Corner corner = n_negative == dim + 1 ? Corner{v, v} :
                                                        negative_pieces<dim>[n_negative - 1][k][v];
          result.corners[k][v] = {static_cast<unsigned char>(sorted[corner.i]),
                                  static_cast<unsigned char>(sorted[corner.j])};
        }
    return result;
  }

  namespace
  {
    /// The part of a piece where phi < 0, as at most three pieces.
    template <int dim>
    Pieces<dim>
    clip(const Piece<dim> &whole, const VertexValues<dim> &phi)
    {
      const Parts<dim> parts = negative_parts<dim>(phi, as_they_are<dim>());

      Pieces<dim> result;
      result.n = parts.n;
      for (unsigned int k = 0; k < parts.n; ++k)
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const auto [i, j] = parts.corners[k][v];
            const double t    = (i == j ? 0. : phi[i] / (phi[i] - phi[j]));

            result.piece[k].x[v]   = whole.x[i] + t * (whole.x[j] - whole.x[i]);
            result.piece[k].psi[v] = (1 - t) * whole.psi[i] + t * whole.psi[j];
          }
      return result;
    }

    template <int dim>
    void
    add(const Simplex<dim> &x, Moments<dim> &moments)
    {
      const double volume = std::abs(signed_volume<dim>(x));
      moments.volume += volume;
      for (const Point<dim> &vertex : x)
        moments.first += volume / (dim + 1) * vertex;
    }
  } // namespace



  // A corner that alone has its sign keeps the product of its edges' parts.
  // Two against two in 3D is a prism: the sum of its three tetrahedra, all
  // terms positive, so nothing cancels.
  template <int dim>
  double
  negative_fraction(const VertexValues<dim> &phi)
  {
    auto               order      = as_they_are<dim>();
    const unsigned int n_negative = negative_first<dim>(phi, order);
    if (n_negative == 0)
      return 0;
    if (n_negative == dim + 1)
      return 1;

    const auto part = [&](const unsigned int i, const unsigned int j) {
      return phi[order[i]] / (phi[order[i]] - phi[order[j]]);
    };
    if (n_negative == 1 || n_negative == dim)
      {
        const unsigned int alone   = (n_negative == 1 ? 0 : dim);
        double             product = 1;
        for (unsigned int i = 0; i <= dim; ++i)
          if (i != alone)
            product *= part(alone, i);
        return alone == 0 ? product : 1 - product;
      }
    if constexpr (dim == 3)
      {
        const double p = part(0, 2), q = part(0, 3);
        const double r = part(1, 2), s = part(1, 3);
        return p * q + p * s * (1 - q) + (1 - p) * r * s;
      }
    else
      return 0; // one of two or three vertices is always alone
  }



  template <int dim>
  Point<dim>
  negative_centroid(const std::array<Point<dim>, dim> &x, const VertexValues<dim - 1> &phi)
  {
    Point<dim>   whole;
    unsigned int n_negative = 0;
    for (unsigned int i = 0; i < dim; ++i)
      {
        whole += x[i] / dim;
        n_negative += phi[i] < 0;
      }
    if (n_negative == 0 || n_negative == dim)
      return whole;

    // the corner at the vertex that is alone with its sign, or what it leaves over
    unsigned int alone = 0;
    while ((phi[alone] < 0) != (n_negative == 1))
      ++alone;
    Point<dim> corner;
    for (unsigned int i = 0; i < dim; ++i)
      {
        const double t = i == alone ? 0. : phi[alone] / (phi[alone] - phi[i]);
        corner += (x[alone] + t * (x[i] - x[alone])) / dim;
      }
    if (n_negative == 1)
      return corner;
    const double part = negative_fraction<dim - 1>(phi);
    return whole + (1 - part) / part * (whole - corner);
  }



  template <int dim>
  Moments<dim>
  liquid_moments(const Simplex<dim>      &x,
                 const VertexValues<dim> &phi,
                 const VertexValues<dim> &psi)
  {
    unsigned int n_liquid = 0, n_open = 0;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        n_liquid += phi[i] < 0;
        n_open += psi[i] > 0;
      }

    Moments<dim> moments;
    if (n_liquid == 0 || n_open == 0)
      return moments;
    if (n_liquid == dim + 1 && n_open == dim + 1)
      {
        add<dim>(x, moments);
        return moments;
      }

    VertexValues<dim> solid;
    for (unsigned int i = 0; i <= dim; ++i)
      solid[i] = -psi[i];
    const Pieces<dim> liquid = clip<dim>({x, solid}, phi);
    for (unsigned int k = 0; k < liquid.n; ++k)
      {
        const Pieces<dim> open = clip<dim>(liquid.piece[k], liquid.piece[k].psi);
        for (unsigned int l = 0; l < open.n; ++l)
          add<dim>(open.piece[l].x, moments);
      }
    return moments;
  }



  template double
  negative_fraction<1>(const VertexValues<1> &);

#define INSTANTIATE(dim)                                                                 \
  template double            negative_fraction<dim>(const VertexValues<dim> &);          \
  template Parts<dim>        negative_parts<dim>(const VertexValues<dim> &,              \
                                          const std::array<unsigned int, dim + 1> &); \
  template Moments<dim>      liquid_moments<dim>(const Simplex<dim> &,                   \
                                            const VertexValues<dim> &,              \
                                            const VertexValues<dim> &);             \
  template Point<dim>        negative_centroid<dim>(const std::array<Point<dim>, dim> &, \
                                             const VertexValues<dim - 1> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
