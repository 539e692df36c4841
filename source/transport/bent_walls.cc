// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/transport/bands.h>
#include <treacle/transport/bent_walls.h>

namespace treacle
{
  template <int dim>
  bool
  walls_bend_in(const Scene<dim> &scene,
                const Point<dim> &centre,
                const double      edge,
                const double      finest,
                const double      time,
                const bool        while_growing)
  {
    // of a finest leaf, between the distance in the middle of a cube and the mean of its vertices; more before a new mesh is made, lest
    // one is for each leaf that a solid moves into
    const double most_bent = while_growing ? 0.25 : 0.4;
    if (!scene.has_solids())
      return false;
    const double reach     = 3 * half_diagonal<dim>(edge); // no more is asked for
    const auto   from      = [&](const Point<dim> &x) { return scene.solid_distance_within(x, reach, time); };
    const double in_middle = from(centre);
    if (std::abs(in_middle) > (while_growing ? 2 : 1) * half_diagonal<dim>(edge))
      return false;
    const auto bend_about = [&](const Point<dim> &x, const double distance) {
      double mean = 0;
      for (unsigned int vertex = 0; vertex < 1u << dim; ++vertex)
        mean += from(vertex_of_cube<dim>(x, edge, vertex)) / (1u << dim);
      return std::abs(distance) < half_diagonal<dim>(edge) && std::abs(mean - distance) > most_bent * finest;
    };
    bool result = bend_about(centre, in_middle);
    for (unsigned int vertex = 0; vertex < 1u << dim && while_growing && !result; ++vertex)
      {
        const Point<dim> x = vertex_of_cube<dim>(centre, edge, vertex);
        result             = bend_about(x, from(x));
      }
    return result;
  }

  template bool
  walls_bend_in(const Scene<2> &, const Point<2> &, const double, const double, const double, const bool);
  template bool
  walls_bend_in(const Scene<3> &, const Point<3> &, const double, const double, const double, const bool);
} // namespace treacle
