// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/scene/near_emitters.h>

#include <algorithm>
#include <cmath>

namespace treacle
{
  template <int dim>
  NearEmitters<dim>::NearEmitters(const BoundingBox<dim> &box)
    : cubes(box)
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
    cubes.clear();
  }

  template <int dim>
  const std::vector<unsigned int> &
  NearEmitters<dim>::around(const std::vector<Emitter<dim>> &emitters, const Point<dim> &x, const double t)
  {
    if (std::find(times.begin(), times.end(), t) == times.end())
      find_at_work(emitters, t);
    return cubes.at(x, [&](const Point<dim> &centre) { return candidates(emitters, centre); }).kept;
  }

  template <int dim>
  std::vector<unsigned int>
  NearEmitters<dim>::candidates(const std::vector<Emitter<dim>> &emitters, const Point<dim> &centre) const
  {
    constexpr double          slack    = 3; // cubes: what goes on beyond a wall is no exact distance
    const double              diagonal = std::sqrt(double(dim)) * cubes.edge;
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
      if (at_work[k] && (emitters[k].is_formula || distances[k] <= nearest + diagonal + slack * cubes.edge))
        result.push_back(k);
    return result;
  }

  template class NearEmitters<2>;
  template class NearEmitters<3>;
} // namespace treacle
