// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/scene/bodies.h>
#include <treacle/scene/emitters.h>

#include <algorithm>

namespace treacle
{
  template <int dim>
  Emitters<dim>::Emitters(const Parameters       &parameters,
                          const Material<dim>    &otherwise,
                          const BoundingBox<dim> &box,
                          const MPI_Comm         &comm)
    : near(box)
  {
    for (unsigned int k = 0; k < parameters.size(); ++k)
      list.emplace_back(parameters[k], numbered("Emitter", k), otherwise, box, comm);
  }

  template <int dim>
  std::pair<const Emitter<dim> *, double>
  Emitters<dim>::nearest_emitter(const Point<dim> &x, const double t) const
  {
    std::pair<const Emitter<dim> *, double> result(nullptr, far_away);
    const auto                              compare = [&](const Emitter<dim> &emitter) {
      if (const double distance = emitter.signed_distance(x); distance < result.second)
        result = {&emitter, distance};
    };
    if (list.size() > 2)
      for (const unsigned int k : near.around(list, x, t))
        compare(list[k]);
    else
      for (const Emitter<dim> &emitter : list)
        if (emitter.is_at_work(t))
          compare(emitter);
    return result;
  }

  template <int dim>
  double
  Emitters<dim>::emitter_distance(const Point<dim> &x, const double t) const
  {
    return nearest_emitter(x, t).second;
  }

  template <int dim>
  Tensor<1, dim>
  Emitters<dim>::emitter_velocity(const Point<dim> &x, const double t) const
  {
    const Emitter<dim> *emitter = nearest_emitter(x, t).first;
    return emitter ? emitter->velocity(x, t) : Tensor<1, dim>();
  }

  template <int dim>
  double
  Emitters<dim>::distance_to_emitter_boundary(const Point<dim> &x, const double t) const
  {
    double smallest = far_away;
    for (const Emitter<dim> &emitter : list)
      if (t < emitter.stop_time)
        smallest = std::min(smallest, std::abs(emitter.signed_distance(x)));
    return smallest;
  }

  template <int dim>
  double
  Emitters<dim>::next_switch(const double t) const
  {
    double next = std::numeric_limits<double>::infinity();
    for (const Emitter<dim> &emitter : list)
      for (const double time : {emitter.start_time, emitter.stop_time})
        if (time > t * (1 + 1e-12))
          next = std::min(next, time);
    return next;
  }

  template <int dim>
  bool
  Emitters<dim>::has_switch_at(const double t) const
  {
    return std::any_of(list.begin(), list.end(), [&](const Emitter<dim> &emitter) {
      return std::abs(emitter.start_time - t) <= 1e-12 * t ||
             std::abs(emitter.stop_time - t) <= 1e-12 * t;
    });
  }

  template class Emitters<2>;
  template class Emitters<3>;
} // namespace treacle
