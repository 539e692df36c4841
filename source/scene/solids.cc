// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/scene/bodies.h>
#include <treacle/scene/solids.h>

namespace treacle
{
  template <int dim>
  Solids<dim>::Solids(const Parameters       &parameters,
                      const BoundingBox<dim> &box,
                      const MPI_Comm         &comm)
  {
    for (unsigned int k = 0; k < parameters.size(); ++k)
      solids.emplace_back(parameters[k], numbered("Solid", k), box, comm);
  }

  template <int dim>
  bool
  Solids<dim>::has_solids() const
  {
    return !solids.empty();
  }

  template <int dim>
  unsigned int
  Solids<dim>::n_solids() const
  {
    return solids.size();
  }

  template <int dim>
  double
  Solids<dim>::solid_distance(const Point<dim> &x, const double t) const
  {
    return solids.empty() ? far_away : nearest_of(x, t).second;
  }

  template <int dim>
  std::pair<const Solid<dim> *, double>
  Solids<dim>::nearest_of(const Point<dim> &x, const double t) const
  {
    return nearest(
      solids,
      [&](const Solid<dim> &solid) { return solid.signed_distance(x, t); },
      [&](const Solid<dim> &solid) { return solid.least_distance(x, t); });
  }

  template <int dim>
  double
  Solids<dim>::solid_distance_within(const Point<dim> &x, const double reach, const double t) const
  {
    const auto distance = [&](const Solid<dim> &solid) {
      return solid.distance_within(x, reach, t);
    };
    return solids.empty() ? far_away : nearest(solids, distance).second;
  }

  template <int dim>
  double
  Solids<dim>::solid_distance(const unsigned int k, const Point<dim> &x, const double t) const
  {
    return solids[k].signed_distance(x, t);
  }

  template <int dim>
  bool
  Solids<dim>::has_moving_solids() const
  {
    return std::any_of(solids.begin(), solids.end(), [](const Solid<dim> &solid) {
      return solid.is_moving();
    });
  }

  template <int dim>
  double
  Solids<dim>::distance_to(const bool moving, const Point<dim> &x, const double t) const
  {
    double distance = far_away;
    for (const Solid<dim> &solid : solids)
      if (solid.is_moving() == moving && solid.least_distance(x, t) < distance)
        distance = std::min(distance, solid.signed_distance(x, t));
    return distance;
  }

  template <int dim>
  double
  Solids<dim>::resting_solid_distance(const Point<dim> &x) const
  {
    return distance_to(false, x, 0);
  }

  template <int dim>
  double
  Solids<dim>::moving_solid_distance(const Point<dim> &x, const double t) const
  {
    return distance_to(true, x, t);
  }

  template <int dim>
  Tensor<1, dim>
  Solids<dim>::solid_velocity(const Point<dim> &x, const double t) const
  {
    return has_moving_solids() ? solids[nearest_solid(x, t)].velocity(x, t) : Tensor<1, dim>();
  }

  template <int dim>
  Tensor<1, dim>
  Solids<dim>::solid_velocity(const unsigned int k, const Point<dim> &x, const double t) const
  {
    return solids[k].velocity(x, t);
  }

  template <int dim>
  unsigned int
  Solids<dim>::nearest_solid(const Point<dim> &x, const double t) const
  {
    if (solids.size() == 1)
      return 0;
    return nearest_of(x, t).first - solids.data();
  }

  template <int dim>
  unsigned int
  Solids<dim>::level_near_solids(const Point<dim> &x, const double distance, const double t) const
  {
    unsigned int level = 0;
    for (const Solid<dim> &solid : solids)
      if (solid.level() > level && std::abs(solid.signed_distance(x, t)) < distance)
        level = solid.level();
    return level;
  }

  template <int dim>
  bool
  Solids<dim>::solids_ask_for_levels() const
  {
    return std::any_of(solids.begin(), solids.end(), [](const Solid<dim> &solid) {
      return solid.level() > 0;
    });
  }

  template <int dim>
  Point<dim>
  Solids<dim>::solid_centre(const unsigned int k, const double t) const
  {
    return solids[k].centre(t);
  }

  template <int dim>
  void
  Solids<dim>::check_solids(const double t) const
  {
    for (const Solid<dim> &solid : solids)
      solid.check(t);
  }

  template class Solids<2>;
  template class Solids<3>;
} // namespace treacle
