// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_base_scattered_h
#define treacle_base_scattered_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace treacle
{
  /// An integer with its bits mixed, the same everywhere (splitmix64).
  inline std::uint64_t
  mixed(std::uint64_t z)
  {
    z += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

  /// A number in [0, 1) from an integer, the same everywhere.
  inline double
  scattered(const std::uint64_t z)
  {
    return static_cast<double>(mixed(z) >> 11) * 0x1p-53;
  }

  /// Such a number for a place, by the number of @p size in its coordinates: the same on all ranks. Round coordinates, where sides of
  /// boxes lie, are inside of a size, not between two.
  template <typename Position>
  double
  scattered_at(const Position &x, const double size)
  {
    std::uint64_t place = 0;
    for (unsigned int d = 0; d < Position::dimension; ++d)
      place = 0x100000001b3ull * place + static_cast<std::int64_t>(std::floor(x[d] / size + 0.618));
    return scattered(place);
  }

  /// Point k of an even sequence in the unit cube (Roberts 2018: steps by the powers of the root of
  /// x^(n+1) = x + 1).
  template <unsigned int n>
  std::array<double, n>
  even_point(const double start, const unsigned int k)
  {
    constexpr double      roots[] = {1.618033988749895, 1.324717957244746, 1.220744084605760};
    std::array<double, n> point;
    double                power = 1, whole;
    for (double &x : point)
      {
        power *= roots[n - 1];
        x = std::modf(start + k / power, &whole);
      }
    return point;
  }

  /// The same in a simplex, in barycentric coordinates: sorted, the coordinates in the cube cut the unit
  /// interval into them.
  template <unsigned int n>
  std::array<double, n + 1>
  even_point_in_simplex(const double start, const unsigned int k)
  {
    std::array<double, n> cut = even_point<n>(start, k);
    std::sort(cut.begin(), cut.end());
    std::array<double, n + 1> lambda;
    for (unsigned int i = 0; i <= n; ++i)
      lambda[i] = (i < n ? cut[i] : 1.) - (i > 0 ? cut[i - 1] : 0.);
    return lambda;
  }
} // namespace treacle

#endif
