// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/geometry/marching.h>
#include <treacle/io/cell_parts.h>
#include <treacle/io/coordinates.h>
#include <treacle/io/liquid_surface.h>

namespace treacle
{
  namespace
  {
    /// The part of this rank. Liquid in a cell, or a part of one, is where two P1 functions are negative, phi
    /// and minus the solid distance: its surface is the zero of each where the other is
    /// negative. The two meet in points of triangles (a face; in 2D the cell), which are
    /// computed from the values at the triangle's corners in the order of their keys: so
    /// cells and ranks agree on them.
    template <int dim>
    class OwnSurface
    {
    public:
      OwnSurface(const State<dim> &state, const LiquidDomain<dim> &domain)
      {
        CellParts<dim> parts(state, domain);
        for (LocalIndex c = 0; c < state.mesh->n_owned_cells(); ++c)
          parts.for_each_part(c, [&](const Simplex &part) { add(part); });
      }

      LiquidSurface<dim> surface;

    private:
      using Corner  = typename CellParts<dim>::Corner;
      using Simplex = typename CellParts<dim>::Simplex;
      using Edge    = std::array<unsigned char, 2>;
      using Vertex  = typename LiquidSurface<dim>::Vertex;

      void
      add(const Simplex &corners)
      {
        simplex = &corners;
        VertexValues<dim> liquid, solid;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            liquid[i] = corners[i].phi;
            solid[i]  = corners[i].solid;
          }
        if (*std::min_element(liquid.begin(), liquid.end()) >= 0)
          return;
        add_facets(liquid, solid, 1);
        add_facets(solid, liquid, 2);
      }

      const std::array<VertexKey, 3> &
      key(const unsigned char i) const
      {
        return (*simplex)[i].key;
      }

      /// The facets of f = 0 where g < 0; @p zero says which of the two f is.
      void
      add_facets(const VertexValues<dim> &f,
                 const VertexValues<dim> &g,
                 const VertexKey          zero)
      {
        const Facets<dim> facets = surface_facets<dim>(f);
        if (facets.n == 0)
          return;
        std::vector<Edge> polygon(facets.facet[0].begin(), facets.facet[0].end());
        if (facets.n == 2)
          polygon.push_back(facets.facet[1][dim - 1]);

        std::vector<std::int32_t> part;
        const unsigned int        n_edges = dim == 2 ? 1 : polygon.size();
        for (unsigned int i = 0; i < polygon.size(); ++i)
          {
            const Edge &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            if (is_negative(f, g, p))
              part.push_back(vertex({{p[0], p[1]}}, f, g, zero));
            if (i < n_edges && is_negative(f, g, p) != is_negative(f, g, q))
              part.push_back(vertex(
                {{p[0], p[1], q[0] == p[0] || q[0] == p[1] ? q[1] : q[0]}}, f, g, 3));
          }
        for (unsigned int k = 0; k + dim <= part.size(); ++k)
          {
            typename LiquidSurface<dim>::Facet facet{{part[0]}};
            for (unsigned int i = 1; i < dim; ++i)
              facet[i] = part[k + i];
            auto sorted = facet;
            std::sort(sorted.begin(), sorted.end());
            if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
              surface.facets.push_back(facet);
          }
      }

      /// Whether g < 0 where f = 0 on an edge. The same product decides, up to its sign,
      /// when f and g change their parts.
      bool
      is_negative(const VertexValues<dim> &f,
                  const VertexValues<dim> &g,
                  const Edge              &e) const
      {
        const unsigned char a = key(e[0]) < key(e[1]) ? e[0] : e[1];
        const unsigned char b = e[0] + e[1] - a;
        const double        d = f[a] * g[b] - f[b] * g[a];
        return f[a] < f[b] ? d > 0 : d < 0;
      }

      /// Where f = 0 on the edge between two vertices of the cell, or f = g = 0 in the
      /// triangle of three. Vertices without weight do not count.
      std::int32_t
      vertex(std::vector<unsigned char> corners,
             const VertexValues<dim>   &f,
             const VertexValues<dim>   &g,
             const VertexKey            zero)
      {
        std::sort(corners.begin(), corners.end(), [&](const auto i, const auto j) {
          return key(i) < key(j);
        });
        const std::array<double, 3> weight = weights(corners, f, g);
        const double                sum    = weight[0] + weight[1] + weight[2];

        Vertex         result{};
        result.keys.fill(no_key);
        result.keys.back() = zero;
        unsigned int   n_keys = 0;
        Point<dim>     x;
        Tensor<1, dim> v;
        for (unsigned int i = 0; i < corners.size(); ++i)
          if (weight[i] > 0)
            {
              const Corner &corner = (*simplex)[corners[i]];
              for (const VertexKey k : corner.key)
                result.keys[n_keys++] = k;
              x += weight[i] / sum * corner.x;
              v += weight[i] / sum * corner.v;
            }
        for (unsigned int d = 0; d < dim; ++d)
          {
            result.position[d] = x[d];
            result.velocity[d] = v[d];
          }
        const auto [it, is_new] = index.emplace(result.keys, surface.vertices.size());
        if (is_new)
          surface.vertices.push_back(result);
        return it->second;
      }

      /// Of two corners where f = 0, or of three where f = g = 0, times any factor.
      static std::array<double, 3>
      weights(const std::vector<unsigned char> &corners,
              const VertexValues<dim>          &f,
              const VertexValues<dim>          &g)
      {
        const unsigned int    n = corners.size();
        std::array<double, 3> weight{};
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned char j = corners[(i + 1) % n], k = corners[(i + 2) % n];
            weight[i] = n == 2 ? std::abs(f[j]) : std::abs(f[j] * g[k] - f[k] * g[j]);
          }
        return weight;
      }

      static constexpr VertexKey no_key = LiquidSurface<dim>::no_key;

      const Simplex                                    *simplex = nullptr;
      std::map<std::array<VertexKey, 10>, std::int32_t> index;
    };
  } // namespace

  namespace
  {
    /// All vertices in the order of their keys, each once.
    template <typename Vertex>
    std::vector<Vertex>
    weld(const PerRank<Vertex> &parts)
    {
      std::vector<Vertex> result;
      for (const auto &part : parts)
        result.insert(result.end(), part.begin(), part.end());
      std::sort(result.begin(), result.end(), [](const Vertex &p, const Vertex &q) {
        return p.keys < q.keys;
      });
      const auto end =
        std::unique(result.begin(), result.end(), [](const Vertex &p, const Vertex &q) {
          return p.keys == q.keys;
        });
      result.erase(end, result.end());
      return result;
    }

    /// Where the vertices of a part are among all.
    template <typename Vertex>
    std::vector<std::int32_t>
    places(const std::vector<Vertex> &part, const std::vector<Vertex> &all)
    {
      std::vector<std::int32_t> result;
      for (const Vertex &vertex : part)
        result.push_back(std::lower_bound(all.begin(),
                                          all.end(),
                                          vertex,
                                          [](const Vertex &p, const Vertex &q) {
                                            return p.keys < q.keys;
                                          }) -
                         all.begin());
      return result;
    }
  } // namespace

  // Facets are in the order of the cells, for each rank has a range of those.
  template <int dim>
  LiquidSurface<dim>
  gather_liquid_surface(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    const MPI_Comm    &comm = state.mesh->communicator();
    const unsigned int n    = Utilities::MPI::n_mpi_processes(comm);
    PerRank<typename LiquidSurface<dim>::Vertex> vertices(n);
    PerRank<typename LiquidSurface<dim>::Facet>  facets(n);
    {
      LiquidSurface<dim> own = std::move(OwnSurface<dim>(state, domain).surface);
      vertices[0]            = std::move(own.vertices);
      facets[0]              = std::move(own.facets);
    }
    vertices = send_and_receive(comm, vertices);
    facets   = send_and_receive(comm, facets);

    LiquidSurface<dim> result;
    result.vertices   = weld(vertices);
    result.in_doubles = need_doubles(*state.mesh);
    for (unsigned int r = 0; r < n; ++r)
      {
        const std::vector<std::int32_t> place = places(vertices[r], result.vertices);
        for (auto facet : facets[r])
          {
            for (auto &i : facet)
              i = place[i];
            result.facets.push_back(facet);
          }
      }
    return result;
  }

  template LiquidSurface<2>
  gather_liquid_surface(const State<2> &, const LiquidDomain<2> &);
  template LiquidSurface<3>
  gather_liquid_surface(const State<3> &, const LiquidDomain<3> &);
} // namespace treacle
