// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Exact identities of the simplex functions on random simplices, and cuts
// whose moments are known.

#include <treacle/geometry/cut_simplex.h>

#include <random>

#include "../tests.h"

namespace tests::geometry_simplex
{
using namespace treacle;

std::mt19937 generator(1);

double
random_value()
{
  return std::uniform_real_distribution<double>(-1, 1)(generator);
}

void
print_error(const std::string &what, const double error)
{
  tests::out() << what << ": " << (error < 1e-11 ? 0. : error) << std::endl;
}

template <int dim>
VertexValues<dim>
random_values()
{
  VertexValues<dim> values;
  for (double &v : values)
    v = random_value();
  return values;
}

/// Right-handed and not too flat.
template <int dim>
Simplex<dim>
random_simplex()
{
  Simplex<dim> x;
  do
    for (Point<dim> &vertex : x)
      for (unsigned int d = 0; d < dim; ++d)
        vertex[d] = random_value();
  while (signed_volume<dim>(x) < 0.05);
  return x;
}

template <int dim>
VertexValues<dim>
negated(VertexValues<dim> values)
{
  for (double &v : values)
    v = -v;
  return values;
}

template <int dim>
void
check_coordinates()
{
  double partition = 0, duality = 0, position = 0, power = 0;
  for (unsigned int sample = 0; sample < 200; ++sample)
    {
      const Simplex<dim> x = random_simplex<dim>();
      const auto         g = basis_gradients<dim>(x);
      Tensor<1, dim>     sum;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          sum += g[i];
          for (unsigned int j = 0; j <= dim; ++j)
            duality =
              std::max(duality,
                       std::abs(g[i] * (x[j] - x[(i + 1) % (dim + 1)]) - (i == j)));
        }
      partition = std::max(partition, sum.norm());

      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = random_value();
      const auto lambda = barycentric_coordinates<dim>(x, p);
      Point<dim> q;
      for (unsigned int i = 0; i <= dim; ++i)
        q += lambda[i] * x[i];
      position = std::max(position, p.distance(q));

      const VertexValues<dim> w = random_values<dim>();
      const Point<dim>        o = weighted_circumcentre<dim>(x, w);
      for (unsigned int i = 1; i <= dim; ++i)
        power = std::max(power,
                         std::abs(o.distance_square(x[i]) - w[i] -
                                  o.distance_square(x[0]) + w[0]) /
                           (1 + o.distance_square(x[0])));
    }
  print_error("sum of gradients", partition);
  print_error("gradients dual to edges", duality);
  print_error("position from barycentric coordinates", position);
  print_error("equal power distances", power);
}

/// Another closed form, for distinct values:
/// sum over the negative i of (-phi_i)^dim / prod_(j != i) (phi_j - phi_i).
template <int dim>
double
spline_fraction(const VertexValues<dim> &phi)
{
  double fraction = 0;
  for (unsigned int i = 0; i <= dim; ++i)
    if (phi[i] < 0)
      {
        double term = 1;
        for (unsigned int j = 0; j <= dim; ++j)
          if (j != i)
            term *= -phi[i] / (phi[j] - phi[i]);
        fraction += term;
      }
  return fraction;
}

template <int dim>
void
check_fractions()
{
  double formula = 0, additivity = 0, symmetry = 0;
  for (unsigned int sample = 0; sample < 1000; ++sample)
    {
      VertexValues<dim> phi      = random_values<dim>();
      const double      fraction = negative_fraction<dim>(phi);

      double gap = 2; // the other form cancels where values are close
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j <= dim; ++j)
          gap = std::min(gap, std::abs(phi[i] - phi[j]));
      if (gap > 0.02)
        formula = std::max(formula, std::abs(fraction - spline_fraction<dim>(phi)));

      const double rest = negative_fraction<dim>(negated<dim>(phi));
      additivity        = std::max(additivity, std::abs(fraction + rest - 1));

      std::shuffle(phi.begin(), phi.end(), generator);
      symmetry = std::max(symmetry, std::abs(fraction - negative_fraction<dim>(phi)));
    }
  print_error("fraction against another closed form", formula);
  print_error("fractions of phi and -phi", additivity);
  print_error("order of the vertices", symmetry);
}

template <int dim>
void
check_moments()
{
  double quarters = 0, first = 0, one_cut = 0, first_positive = 1;
  for (unsigned int sample = 0; sample < 500; ++sample)
    {
      const Simplex<dim>      x   = random_simplex<dim>();
      const VertexValues<dim> phi = random_values<dim>(), psi = random_values<dim>();
      const double            volume = signed_volume<dim>(x);

      Point<dim> centre;
      for (const Point<dim> &vertex : x)
        centre += vertex / (dim + 1);
      double         sum       = -volume;
      Tensor<1, dim> first_sum = -volume * centre;
      for (const auto &f : {phi, negated<dim>(phi)})
        for (const auto &s : {psi, negated<dim>(psi)})
          {
            const Moments<dim> part = liquid_moments<dim>(x, f, s);
            sum += part.volume;
            first_sum += part.first;
            first_positive = std::min(first_positive, part.volume);
          }
      quarters = std::max(quarters, std::abs(sum));
      first    = std::max(first, first_sum.norm());

      VertexValues<dim> open;
      open.fill(1);
      one_cut = std::max(one_cut,
                         std::abs(liquid_moments<dim>(x, phi, open).volume -
                                  volume * negative_fraction<dim>(phi)));
    }
  print_error("volumes of the four parts", quarters);
  print_error("first moments of the four parts", first);
  print_error("negative volume", -first_positive);
  print_error("volume against fraction", one_cut);

  // the unit simplex, { last coordinate < 1/2 and x_1 > 1/4 }; flat values
  Simplex<dim> unit;
  for (unsigned int d = 0; d < dim; ++d)
    unit[d + 1][d] = 1;
  VertexValues<dim> phi, psi, zero;
  phi.fill(-0.5);
  phi[dim] = 0.5;
  psi.fill(-0.25);
  psi[1] = 0.75;
  zero.fill(0);
  const Moments<dim> part = liquid_moments<dim>(unit, phi, psi);
  tests::out() << "unit simplex cut twice: " << part.volume << ", " << part.first
               << std::endl
               << "zero is air and solid: " << liquid_moments<dim>(unit, zero, psi).volume
               << ' ' << liquid_moments<dim>(unit, phi, zero).volume << std::endl;
}

template <int dim>
void
check_areas()
{
  double closed = 0, gauss = 0;
  for (unsigned int sample = 0; sample < 200; ++sample)
    {
      const Simplex<dim> x = random_simplex<dim>();
      Tensor<1, dim>     sum;
      double             flux = 0;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          std::array<Point<dim>, dim> face;
          for (unsigned int k = 0; k < dim; ++k)
            face[k] = x[(i + 1 + k) % (dim + 1)];
          // a cyclic shift of four vertices is odd
          if (dim == 3 && i % 2 == 1)
            std::swap(face[0], face[1]);
          const Tensor<1, dim> area = area_vector<dim>(face);
          sum += area;
          flux += area * face[0] / dim;
        }
      closed = std::max(closed, sum.norm());
      gauss  = std::max(gauss, std::abs(flux - signed_volume<dim>(x)));
    }
  print_error("sum of area vectors", closed);
  print_error("outward flux of x/dim against volume", gauss);
}

template <int dim>
void
check()
{
  tests::out() << "dimension " << dim << std::endl;
  check_coordinates<dim>();
  check_fractions<dim>();
  check_moments<dim>();
  check_areas<dim>();
}

void
start(const int, char **)
{

  check<2>();
  check<3>();

  std::ostream &out = tests::out();
  out << "fractions of known cuts" << std::endl;
  for (const auto &phi :
       {VertexValues<1>{{-1, 3}}, {{3, -1}}, {{0, 1}}, {{-1, 0}}, {{0, 0}}})
    out << negative_fraction<1>(phi) << ' ';
  out << std::endl;
  for (const auto &phi : {VertexValues<2>{{-1, 1, 1}},
                          {{1, -1, -1}},
                          {{-1, 0, 0}},
                          {{0, 1, 0}},
                          {{-2, 0, 1}}})
    out << negative_fraction<2>(phi) << ' ';
  out << std::endl;
  for (const auto &phi : {VertexValues<3>{{-1, 1, 1, 1}},
                          {{1, -1, 1, -1}},
                          {{-1, -1, 1, -1}},
                          {{0, 0, -1, 0}},
                          {{-1, 0, 0, -1e-300}},
                          {{0, 0, 0, 0}},
                          {{-1, 2, -3, 4}}})
    out << negative_fraction<3>(phi) << ' ';
  out << std::endl;
}

const Test test("geometry/simplex", start);
} // namespace tests::geometry_simplex
