// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_scene_near_emitters_h
#define treacle_scene_near_emitters_h

#include <treacle/geometry/kept_in_cubes.h>
#include <treacle/scene/emitter.h>

#include <array>

namespace treacle
{
  /// Which of many emitters may be the nearest one at work, cube by cube: those as near to its centre as the nearest there, but for its
  /// extent.
  template <int dim>
  class NearEmitters
  {
  public:
    explicit NearEmitters(const BoundingBox<dim> &box);

    /// Of a list that is always the same, in its order, at work from t on. No longer than until the next call.
    const std::vector<unsigned int> &
    around(const std::vector<Emitter<dim>> &emitters, const Point<dim> &x, const double t);

  private:
    void
    find_at_work(const std::vector<Emitter<dim>> &emitters, const double t);

    std::vector<unsigned int>
    candidates(const std::vector<Emitter<dim>> &emitters, const Point<dim> &centre) const;

    std::array<double, 2> times;     ///< last asked for (s): a step asks for its middle and its begin in turn
    std::vector<bool>     at_work; ///< at both

    KeptInCubes<dim, std::vector<unsigned int>> cubes;
  };
} // namespace treacle

#endif
