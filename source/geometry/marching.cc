// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/marching.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    std::array<unsigned char, 2>
    edge(const unsigned int i, const unsigned int j)
    {
      return {{static_cast<unsigned char>(std::min(i, j)),
               static_cast<unsigned char>(std::max(i, j))}};
    }

    Facets<2>
    facets_of(const VertexValues<2> &phi)
    {
      Facets<2>          facets{};
      const unsigned int n_negative = (phi[0] < 0) + (phi[1] < 0) + (phi[2] < 0);
      if (n_negative == 0 || n_negative == 3)
        return facets;

      const bool   liquid = (n_negative == 1);
      unsigned int i      = 0; // the vertex that is alone on its side
      while ((phi[i] < 0) != liquid)
        ++i;
      const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;

      facets.n = 1;
      if (liquid)
        facets.facet[0] = {{edge(i, j), edge(i, k)}};
      else
        facets.facet[0] = {{edge(i, k), edge(i, j)}};
      return facets;
    }

    // Vertices are listed as even permutations: in a right-handed tetrahedron
    // (a,b,c,d) the triangle (b,c,d) turns its area vector away from a.
    Facets<3>
    facets_of(const VertexValues<3> &phi)
    {
      static constexpr unsigned char one[4][4] = {{0, 1, 2, 3},
                                                  {1, 0, 3, 2},
                                                  {2, 3, 0, 1},
                                                  {3, 2, 1, 0}};
      static constexpr unsigned char two[6][4] = {{0, 1, 2, 3},
                                                  {0, 2, 3, 1},
                                                  {0, 3, 1, 2},
                                                  {1, 2, 0, 3},
                                                  {1, 3, 2, 0},
                                                  {2, 3, 0, 1}};

      Facets<3>          facets{};
      const unsigned int n_negative =
        (phi[0] < 0) + (phi[1] < 0) + (phi[2] < 0) + (phi[3] < 0);

      if (n_negative == 1 || n_negative == 3)
        {
          const bool   liquid = (n_negative == 1);
          unsigned int i      = 0;
          while ((phi[i] < 0) != liquid)
            ++i;
          const auto &v   = one[i];
          facets.n        = 1;
          facets.facet[0] = {{edge(v[0], v[1]), edge(v[0], v[2]), edge(v[0], v[3])}};
          if (!liquid)
            std::swap(facets.facet[0][1], facets.facet[0][2]);
        }
      else if (n_negative == 2)
        {
          unsigned int pair = 0;
          while (!(phi[two[pair][0]] < 0 && phi[two[pair][1]] < 0))
            ++pair;
          const auto &v   = two[pair];
          facets.n        = 2;
          facets.facet[0] = {{edge(v[0], v[2]), edge(v[0], v[3]), edge(v[1], v[3])}};
          facets.facet[1] = {{edge(v[0], v[2]), edge(v[1], v[3]), edge(v[1], v[2])}};
        }
      return facets;
    }
  } // namespace



  template <int dim>
  Facets<dim>
  surface_facets(const VertexValues<dim> &phi)
  {
    return facets_of(phi);
  }

  template Facets<2>
  surface_facets<2>(const VertexValues<2> &);
  template Facets<3>
  surface_facets<3>(const VertexValues<3> &);
} // namespace treacle
