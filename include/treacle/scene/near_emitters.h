// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_near_emitters_h
#define treacle_scene_near_emitters_h

#include <treacle/scene/emitter.h>

#include <unordered_map>

namespace treacle
{
  /// Which of many emitters may be the nearest one at work, cube by cube: those as near to its centre as the nearest there, but for its
  /// extent. (A shower of 25 asked all for each point about each: 22 s a step for 3.)
  template <int dim>
  class NearEmitters
  {
  public:
    explicit NearEmitters(const BoundingBox<dim> &box);

    /// Of a list that is always the same, in its order, at work from t on. No longer than until the next call.
    const std::vector<unsigned int> &
    around(const std::vector<Emitter<dim>> &emitters, const Point<dim> &x, const double t);

  private:
    std::vector<unsigned int>
    candidates(const std::vector<Emitter<dim>> &emitters, const Point<dim> &centre) const;

    const BoundingBox<dim> box;
    const double           edge;    ///< of cubes (m)
    double                 time;    ///< last asked for (s)
    std::vector<bool>      at_work; ///< then

    std::unordered_map<std::uint64_t, std::vector<unsigned int>> of_cube;
  };
} // namespace treacle

#endif
