// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_geometry_kept_in_cubes_h
#define treacle_geometry_kept_in_cubes_h

#include <treacle/base/types.h>

#include <deal.II/base/bounding_box.h>

#include <cmath>
#include <unordered_map>

namespace treacle
{
  /// What is found once for each of the cubes, 128 along the diagonal of a box, in which points are that lie close together.
  template <int dim, typename T>
  class KeptInCubes
  {
  public:
    explicit KeptInCubes(const BoundingBox<dim> &box)
      : lower(box.get_boundary_points().first)
      , edge(lower.distance(box.get_boundary_points().second) / 128)
    {}

    struct Cube
    {
      Point<dim> centre;
      T          kept;
    };

    /// The cube of a point, in the box or not, with what @p find finds for its centre. Good until the next call.
    template <typename Find>
    const Cube &
    at(const Point<dim> &x, const Find &find)
    {
      constexpr std::uint64_t bits = 21, middle = 1 << (bits - 1);
      Point<dim>              centre;
      std::uint64_t           key = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double index = std::floor((x[d] - lower[d]) / edge);
          centre[d]          = lower[d] + (index + 0.5) * edge;
          key                = key << bits | static_cast<std::uint64_t>(index + middle);
        }
      // far off several have the same key
      if (const auto known = cubes.find(key); known != cubes.end() && known->second.centre == centre)
        return known->second;
      constexpr unsigned int most = 1 << 18; // some 25 MiB
      if (cubes.size() == most)
        cubes.clear();
      return cubes.insert_or_assign(key, Cube{centre, find(centre)}).first->second;
    }

    void
    clear()
    {
      cubes.clear();
    }

    const Point<dim> lower;
    const double     edge; ///< of cubes (m)

  private:
    std::unordered_map<std::uint64_t, Cube> cubes;
  };
} // namespace treacle

#endif
