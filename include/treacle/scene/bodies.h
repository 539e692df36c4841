// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_bodies_h
#define treacle_scene_bodies_h

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treacle
{
  using namespace dealii;

  /// What stands for a distance from nothing (m): finite, for it is interpolated.
  constexpr double far_away = 1e30;

  /// The subsection of body k (from 0), as "Liquid 1".
  inline std::string
  numbered(const std::string &name, const unsigned int k)
  {
    return name + " " + std::to_string(k + 1);
  }

  /// Declare the subsections of n bodies.
  template <typename Parameters>
  void
  add_numbered(ParameterHandler        &prm,
               const std::string       &name,
               std::vector<Parameters> &bodies,
               const unsigned int       n)
  {
    bodies.resize(n);
    for (unsigned int k = 0; k < n; ++k)
      {
        prm.enter_subsection(numbered(name, k));
        bodies[k].add_parameters(prm);
        prm.leave_subsection();
      }
  }

  /// The entry with the smallest distance (there is at least one; of equal ones the first), and it.
  template <typename Body, typename Distance>
  std::pair<const Body *, double>
  nearest(const std::vector<Body> &bodies, const Distance &distance_of)
  {
    std::pair<const Body *, double> result(nullptr,
                                           std::numeric_limits<double>::infinity());
    for (const Body &body : bodies)
      if (const double distance = distance_of(body);
          result.first == nullptr || distance < result.second)
        result = {&body, distance};
    return result;
  }

  /// The same. Those that are known to be farther than another, by what @p least_of says of them, are not asked.
  template <typename Body, typename Distance, typename Least>
  std::pair<const Body *, double>
  nearest(const std::vector<Body> &bodies, const Distance &distance_of, const Least &least_of)
  {
    const Body *begin = &*std::min_element(
      bodies.begin(), bodies.end(), [&](const Body &a, const Body &b) { return least_of(a) < least_of(b); });
    std::pair<const Body *, double> result(begin, distance_of(*begin));
    if (std::isnan(result.second)) // a formula
      return nearest(bodies, distance_of);
    for (const Body &body : bodies)
      if (&body != begin && least_of(body) <= result.second)
        if (const double distance = distance_of(body);
            distance < result.second || (distance == result.second && &body < result.first))
          result = {&body, distance};
    return result;
  }
} // namespace treacle

#endif
