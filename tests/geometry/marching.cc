// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The surface in a simplex closes the liquid: its area vectors and those of
// the wet parts of the faces sum to zero. All sign patterns are listed.

#include <treacle/geometry/cut_simplex.h>
#include <treacle/geometry/marching.h>

#include <random>

#include "../tests.h"

namespace tests::geometry_marching
{
using namespace treacle;

template <int dim>
Tensor<1, dim>
outward_area(const Simplex<dim> &x, const unsigned int i)
{
  return -dim * signed_volume<dim>(x) * basis_gradients<dim>(x)[i];
}

template <int dim>
std::array<Point<dim>, dim>
positions(const CutEdges<dim>     &facet,
          const Simplex<dim>      &x,
          const VertexValues<dim> &phi,
          double                  &largest_phi)
{
  std::array<Point<dim>, dim> result;
  for (unsigned int k = 0; k < dim; ++k)
    {
      const auto [a, b]  = facet[k];
      const double t     = edge_zero(phi[a], phi[b]);
      const bool   valid = (a < b && t >= 0 && t <= 1);
      result[k]          = x[a] + t * (x[b] - x[a]);
      largest_phi =
        std::max(largest_phi, valid ? std::abs(phi[a] + t * (phi[b] - phi[a])) : 1.);
    }
  return result;
}

template <int dim>
void
check_closure()
{
  std::mt19937                           generator(2);
  std::uniform_real_distribution<double> random(-1, 1);

  double closed = 0, parallel = 0, largest_phi = 0;
  for (unsigned int sample = 0; sample < 1000; ++sample)
    {
      Simplex<dim>      x;
      VertexValues<dim> phi;
      do
        for (unsigned int i = 0; i <= dim; ++i)
          {
            phi[i] = random(generator);
            for (unsigned int d = 0; d < dim; ++d)
              x[i][d] = random(generator);
          }
      while (signed_volume<dim>(x) < 0.05);

      Tensor<1, dim> sum, gradient;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          gradient += phi[i] * basis_gradients<dim>(x)[i];
          VertexValues<dim - 1> on_face;
          for (unsigned int k = 0; k < dim; ++k)
            on_face[k] = phi[(i + 1 + k) % (dim + 1)];
          sum += negative_fraction<dim - 1>(on_face) * outward_area<dim>(x, i);
        }

      const Facets<dim> facets = surface_facets<dim>(phi);
      for (unsigned int f = 0; f < facets.n; ++f)
        {
          const Tensor<1, dim> area =
            area_vector<dim>(positions<dim>(facets.facet[f], x, phi, largest_phi));
          sum += area;
          parallel = std::max(parallel, area.norm() - area * gradient / gradient.norm());
        }
      closed = std::max(closed, sum.norm());
    }
  const auto clean = [](const double error) { return error < 1e-11 ? 0. : error; };
  tests::out() << "dimension " << dim << std::endl
               << "sum of area vectors around the liquid: " << clean(closed) << std::endl
               << "facets along the gradient: " << clean(parallel) << std::endl
               << "phi on the facets: " << clean(largest_phi) << std::endl;
}

template <int dim>
void
list_patterns()
{
  for (unsigned int pattern = 0; pattern < (1u << (dim + 1)); ++pattern)
    {
      VertexValues<dim> phi;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          phi[i] = (pattern >> i & 1) ? -1 : 0; // zero counts as air
          tests::out() << (phi[i] < 0 ? '-' : '0');
        }
      const Facets<dim> facets = surface_facets<dim>(phi);
      for (unsigned int f = 0; f < facets.n; ++f)
        {
          tests::out() << "  ";
          for (const auto &edge : facets.facet[f])
            tests::out() << ' ' << int(edge[0]) << int(edge[1]);
        }
      tests::out() << std::endl;
    }
}

void
start(const int, char **)
{

  check_closure<2>();
  list_patterns<2>();
  check_closure<3>();
  list_patterns<3>();
}

const Test test("geometry/marching", start);
} // namespace tests::geometry_marching
