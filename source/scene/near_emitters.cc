// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/scene/near_emitters.h>

#include <algorithm>
#include <cmath>

namespace treacle
{
  namespace
  {
    constexpr unsigned int bits = 20; // of an index of cubes in one direction

    template <int dim>
    double
    edge_of_cubes(const BoundingBox<dim> &box)
    {
      double shortest = box.side_length(0), longest = shortest;
      for (unsigned int d = 1; d < dim; ++d)
        {
          shortest = std::min(shortest, box.side_length(d));
          longest  = std::max(longest, box.side_length(d));
        }
      return std::max(shortest / 64, longest / ((1 << bits) - 1));
    }
  } // namespace

  template <int dim>
  NearEmitters<dim>::NearEmitters(const BoundingBox<dim> &box)
    : box(box)
    , edge(edge_of_cubes(box))
  {
    times.fill(std::numeric_limits<double>::quiet_NaN());
  }

  template <int dim>
  void
  NearEmitters<dim>::find_at_work(const std::vector<Emitter<dim>> &emitters, const double t)
  {
    std::vector<bool> now;
    for (const Emitter<dim> &emitter : emitters)
      now.push_back(emitter.is_at_work(t));
    times = {{t, times[0]}};
    if (now == at_work)
      return;
    times[1] = t;
    at_work  = now;
    of_cube.clear();
  }

  template <int dim>
  const std::vector<unsigned int> &
  NearEmitters<dim>::around(const std::vector<Emitter<dim>> &emitters, const Point<dim> &x, const double t)
  {
    if (std::find(times.begin(), times.end(), t) == times.end())
      find_at_work(emitters, t);
    // outside of the box emitters are as far as on its sides
    Point<dim>    centre;
    std::uint64_t key = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double inside = std::clamp(x[d], box.lower_bound(d), box.upper_bound(d));
        const double index  = std::floor((inside - box.lower_bound(d)) / edge);
        centre[d]           = box.lower_bound(d) + (index + 0.5) * edge;
        key                 = key << bits | static_cast<std::uint64_t>(index);
      }
    if (const auto known = of_cube.find(key); known != of_cube.end())
      return known->second;
    constexpr unsigned int most = 1 << 18; // 25 MiB
    if (of_cube.size() == most)
      of_cube.clear();
    return of_cube.emplace(key, candidates(emitters, centre)).first->second;
  }

  template <int dim>
  std::vector<unsigned int>
  NearEmitters<dim>::candidates(const std::vector<Emitter<dim>> &emitters, const Point<dim> &centre) const
  {
    constexpr double          slack    = 2; // cubes: what goes on beyond a wall is no exact distance
    const double              diagonal = std::sqrt(double(dim)) * edge;
    double                    nearest  = std::numeric_limits<double>::infinity();
    std::vector<double>       distances;
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < emitters.size(); ++k)
      {
        distances.push_back(emitters[k].signed_distance(centre));
        if (at_work[k] && !emitters[k].is_formula)
          nearest = std::min(nearest, distances[k]);
      }
    for (unsigned int k = 0; k < emitters.size(); ++k)
      if (at_work[k] && (emitters[k].is_formula || distances[k] <= nearest + diagonal + slack * edge))
        result.push_back(k);
    return result;
  }

  template class NearEmitters<2>;
  template class NearEmitters<3>;
} // namespace treacle
