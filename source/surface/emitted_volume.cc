// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/cut_simplex.h>
#include <treacle/surface/emitted_volume.h>

#include <algorithm>
#include <numeric>

namespace treacle
{
  template <int dim>
  EmittedVolume<dim>::LongestEdge::LongestEdge(const Vertices &v)
  {
    for (unsigned int a = 0; a <= dim; ++a)
      for (unsigned int b = 0; b < a; ++b)
        if (const double between = v[a].x.distance(v[b].x); between > length)
          {
            i      = a;
            j      = b;
            length = between;
          }
  }

  template <int dim>
  bool
  EmittedVolume<dim>::is_far(const Vertices &v, const LongestEdge &edge)
  {
    constexpr double alike = 1e-6;
    const auto is_in_solid = [](const Vertex &a) { return a.psi <= 0; };
    const auto is_alike    = [&](const Vertex &a) {
      return std::min(std::abs(a.phi.inside), std::abs(a.phi.kept)) > edge.length ||
             std::abs(a.phi.inside - a.phi.kept) < alike * edge.length;
    };
    return std::all_of(v.begin(), v.end(), is_in_solid) || std::all_of(v.begin(), v.end(), is_alike);
  }

  template <int dim>
  std::array<typename EmittedVolume<dim>::Vertices, 2>
  EmittedVolume<dim>::halved(const Vertices &v, const LongestEdge &edge) const
  {
    const Vertex           &a = v[edge.i], &b = v[edge.j];
    std::array<Vertices, 2> halves{{v, v}};
    halves[0][edge.i] = halves[1][edge.j] = vertex(a.x + 0.5 * (b.x - a.x), 0.5 * (a.old + b.old), 0.5 * (a.psi + b.psi));
    return halves;
  }

  template <int dim>
  double
  EmittedVolume<dim>::after(const Vertices &v, const unsigned int halvings) const
  {
    constexpr unsigned int rounds = 2;
    const LongestEdge      edge(v);
    if (is_far(v, edge))
      return volume(v);
    if (halvings == 0)
      return in_rounds(v, volume(v), rounds);
    const auto halves = halved(v, edge);
    return after(halves[0], halvings - 1) + after(halves[1], halvings - 1);
  }

  template <int dim>
  double
  EmittedVolume<dim>::in_rounds(const Vertices &v, const double whole, const unsigned int rounds) const
  {
    constexpr double       tolerance = 2e-3; // of the simplex
    constexpr unsigned int n_parts   = 1 << dim;
    if (rounds == 0 || is_far(v, LongestEdge(v)))
      return whole;
    std::array<Vertices, n_parts> parts{{v}};
    for (unsigned int n = 1; n < n_parts; n *= 2)
      for (unsigned int k = 0; k < n; ++k)
        {
          const auto halves = halved(parts[k], LongestEdge(parts[k]));
          parts[k]          = halves[0];
          parts[n + k]      = halves[1];
        }
    std::array<double, n_parts> volumes;
    std::transform(parts.begin(), parts.end(), volumes.begin(), [](const Vertices &part) { return volume(part); });
    double       sum = std::accumulate(volumes.begin(), volumes.end(), 0.);
    Simplex<dim> x;
    std::transform(v.begin(), v.end(), x.begin(), [](const Vertex &vertex) { return vertex.x; });
    if (std::abs(sum - whole) < tolerance * std::abs(signed_volume<dim>(x)))
      return sum;
    sum = 0;
    for (unsigned int k = 0; k < n_parts; ++k)
      sum += in_rounds(parts[k], volumes[k], rounds - 1);
    return sum;
  }

  template <int dim>
  double
  EmittedVolume<dim>::volume(const Vertices &v)
  {
    Simplex<dim>      x;
    VertexValues<dim> inside, kept, psi;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        x[i]      = v[i].x;
        inside[i] = v[i].phi.inside;
        kept[i]   = v[i].phi.kept;
        psi[i]    = v[i].psi;
      }
    return liquid_moments<dim>(x, inside, psi).volume - liquid_moments<dim>(x, kept, psi).volume;
  }

  template class EmittedVolume<2>;
  template class EmittedVolume<3>;
} // namespace treacle
