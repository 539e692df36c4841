// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/simplex.h>

namespace treacle
{
  namespace
  {
    Tensor<1, 2>
    clockwise(const Tensor<1, 2> &v)
    {
      Tensor<1, 2> turned;
      turned[0] = v[1];
      turned[1] = -v[0];
      return turned;
    }
  } // namespace

  template <int dim>
  double
  signed_volume(const Simplex<dim> &x)
  {
    if constexpr (dim == 2)
      return (x[1] - x[0]) * clockwise(x[2] - x[0]) / 2;
    else
      return (x[1] - x[0]) * cross_product_3d(x[2] - x[0], x[3] - x[0]) / 6;
  }



  template <int dim>
  std::array<Tensor<1, dim>, dim + 1>
  basis_gradients(const Simplex<dim> &x)
  {
    std::array<Tensor<1, dim>, dim + 1> g;

    const Tensor<1, dim> a = x[1] - x[0], b = x[2] - x[0];
    if constexpr (dim == 2)
      {
        g[1] = clockwise(b);
        g[2] = -clockwise(a);
      }
    else
      {
        const Tensor<1, dim> c = x[3] - x[0];

        g[1] = cross_product_3d(b, c);
        g[2] = cross_product_3d(c, a);
        g[3] = cross_product_3d(a, b);
      }

    const double scale = 1 / (a * g[1]);
    for (unsigned int i = 1; i <= dim; ++i)
      {
        g[i] *= scale;
        g[0] -= g[i];
      }
    return g;
  }



  // The gradients are the basis dual to the edges x_i - x_0, so they invert
  // the linear system of the dual centre.
  template <int dim>
  Point<dim>
  weighted_circumcentre(const Simplex<dim> &x, const VertexValues<dim> &w)
  {
    const auto g = basis_gradients<dim>(x);
    Point<dim> o = x[0];
    for (unsigned int i = 1; i <= dim; ++i)
      o += 0.5 * ((x[i] - x[0]).norm_square() - w[i] + w[0]) * g[i];
    return o;
  }



  template <int dim>
  Tensor<1, dim>
  area_vector(const std::array<Point<dim>, dim> &x)
  {
    if constexpr (dim == 2)
      return clockwise(x[1] - x[0]);
    else
      return 0.5 * cross_product_3d(x[1] - x[0], x[2] - x[0]);
  }



#define INSTANTIATE(dim)                                                                 \
  template double                              signed_volume<dim>(const Simplex<dim> &); \
  template std::array<Tensor<1, dim>, dim + 1> basis_gradients<dim>(                     \
    const Simplex<dim> &);                                                               \
  template Point<dim>        weighted_circumcentre<dim>(const Simplex<dim> &,            \
                                                 const VertexValues<dim> &);      \
  template Tensor<1, dim>    area_vector<dim>(const std::array<Point<dim>, dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
