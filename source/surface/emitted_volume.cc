// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/cut_simplex.h>
#include <treacle/surface/emitted_volume.h>

#include <algorithm>
#include <numeric>

namespace treacle
{
  namespace
  {
    /// A simplex that is halved again and again.
    template <int dim>
    class HalvedSimplex
    {
    public:
      using Vertex = typename EmittedVolume<dim>::Vertex;
      using Part   = typename EmittedVolume<dim>::Vertices;

      explicit HalvedSimplex(EmittedVolume<dim> &vertices)
        : vertices(vertices)
      {}

      /// (m^dim)
      double
      volume(const Part &whole)
      {
        return after(whole, dim);
      }

    private:
      struct LongestEdge
      {
        unsigned int i = 0, j = 0;
        double       length = 0; ///< (m)
      };

      LongestEdge
      longest_edge(const Part &v) const
      {
        LongestEdge edge;
        double      longest = 0; // squared
        for (unsigned int a = 0; a <= dim; ++a)
          for (unsigned int b = 0; b < a; ++b)
            if (const double between = vertices[v[a]].x.distance_square(vertices[v[b]].x); between > longest)
              {
                edge    = {a, b, 0};
                longest = between;
              }
        edge.length = std::sqrt(longest);
        return edge;
      }

      /// From where anything flows in, or in solids.
      bool
      is_far(const Part &v, const LongestEdge &edge) const
      {
        constexpr double alike       = 1e-6;
        const auto       is_in_solid = [&](const unsigned int i) { return vertices[i].psi <= 0; };
        const auto       is_alike    = [&](const unsigned int i) {
          const auto &phi = vertices[i].phi;
          return std::min(std::abs(phi.inside), std::abs(phi.kept)) > edge.length ||
                 std::abs(phi.inside - phi.kept) < alike * edge.length;
        };
        return std::all_of(v.begin(), v.end(), is_in_solid) || std::all_of(v.begin(), v.end(), is_alike);
      }

      std::array<Part, 2>
      halved(const Part &v, const LongestEdge &edge)
      {
        std::array<Part, 2> halves{{v, v}};
        halves[0][edge.i] = halves[1][edge.j] = vertices.middle(v[edge.i], v[edge.j]);
        return halves;
      }

      /// When it has been halved so often.
      double
      after(const Part &v, const unsigned int halvings)
      {
        constexpr unsigned int rounds = 2;
        const LongestEdge      edge   = longest_edge(v);
        if (is_far(v, edge))
          return as_shown(v);
        if (halvings == 0)
          return in_rounds(v, as_shown(v), rounds);
        const auto halves = halved(v, edge);
        return after(halves[0], halvings - 1) + after(halves[1], halvings - 1);
      }

      /// A simplex of a @p whole volume (m^dim) is halved in each direction, as often as that changes it.
      double
      in_rounds(const Part &v, const double whole, const unsigned int rounds)
      {
        constexpr double       tolerance = 2e-3; // of the simplex
        constexpr unsigned int n_parts   = 1 << dim;
        if (rounds == 0)
          return whole;
        const LongestEdge edge = longest_edge(v);
        if (is_far(v, edge))
          return whole;
        std::array<Part, n_parts> parts{{v}};
        for (unsigned int n = 1; n < n_parts; n *= 2)
          for (unsigned int k = 0; k < n; ++k)
            {
              const auto halves = halved(parts[k], n == 1 ? edge : longest_edge(parts[k]));
              parts[k]          = halves[0];
              parts[n + k]      = halves[1];
            }
        std::array<double, n_parts> volumes;
        std::transform(
          parts.begin(), parts.end(), volumes.begin(), [this](const Part &part) { return as_shown(part); });
        double       sum = std::accumulate(volumes.begin(), volumes.end(), 0.);
        if (std::abs(sum - whole) < tolerance * std::abs(signed_volume<dim>(positions(v))))
          return sum;
        sum = 0;
        for (unsigned int k = 0; k < n_parts; ++k)
          sum += in_rounds(parts[k], volumes[k], rounds - 1);
        return sum;
      }

      Simplex<dim>
      positions(const Part &v) const
      {
        Simplex<dim> x;
        std::transform(v.begin(), v.end(), x.begin(), [this](const unsigned int i) { return vertices[i].x; });
        return x;
      }

      /// Its volume as functions that are linear in it show it.
      double
      as_shown(const Part &v) const
      {
        VertexValues<dim> inside, kept, psi;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            const Vertex &vertex = vertices[v[i]];
            inside[i]            = vertex.phi.inside;
            kept[i]              = vertex.phi.kept;
            psi[i]               = vertex.psi;
          }
        const Simplex<dim> x = positions(v);
        if (*std::min_element(psi.begin(), psi.end()) > 0)
          return std::abs(signed_volume<dim>(x)) * (negative_fraction<dim>(inside) - negative_fraction<dim>(kept));
        return liquid_moments<dim>(x, inside, psi).volume - liquid_moments<dim>(x, kept, psi).volume;
      }

      EmittedVolume<dim> &vertices;
    };
  } // namespace

  template <int dim>
  unsigned int
  EmittedVolume<dim>::middle(const unsigned int i, const unsigned int j)
  {
    const std::uint64_t edge = std::uint64_t(std::min(i, j)) << 32 | std::max(i, j);
    if (const auto known = middles.find(edge); known != middles.end())
      return known->second;
    const Vertex a = vertices[i], b = vertices[j];
    add(Point<dim>(0.5 * (a.x + Tensor<1, dim>(b.x))), 0.5 * (a.old + b.old), 0.5 * (a.psi + b.psi), 0.5 * (a.v + b.v));
    return middles[edge] = vertices.size() - 1;
  }

  template <int dim>
  double
  EmittedVolume<dim>::operator()(const Vertices &simplex)
  {
    return HalvedSimplex<dim>(*this).volume(simplex);
  }

  template class EmittedVolume<2>;
  template class EmittedVolume<3>;
} // namespace treacle
