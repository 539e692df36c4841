// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_opening.h>
#include <treacle/geometry/cut_simplex.h>
#include <treacle/scene/bodies.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    /// The part of a face within a body; a face that lies along the body's side bounds it.
    template <int dim>
    double
    fraction_within(const VertexValues<dim> &distance)
    {
      return *std::max_element(distance.begin(), distance.end()) <= 0 ? 1. : negative_fraction<dim>(distance);
    }
  } // namespace

  template <int dim>
  typename FaceOpening<dim>::Vertices
  FaceOpening<dim>::vertices(const LocalIndex f) const
  {
    Vertices v;
    for (unsigned int i = 0; i < dim; ++i)
      {
        const LocalIndex node = mesh.face_nodes[f][i];
        v.x[i]                = mesh.node_position[node];
        v.solid[i]            = solid_distance[node];
        v.emitter[i]          = emitter_distance.empty() ? far_away : emitter_distance[node];
      }
    return v;
  }

  template <int dim>
  double
  FaceOpening<dim>::solid_fraction(const Vertices &v) const
  {
    VertexValues<dim - 1> in_solids;
    for (unsigned int i = 0; i < dim; ++i)
      in_solids[i] = std::max(v.solid[i], 0.5 * (v.solid[i] - v.emitter[i]));
    return fraction_within<dim - 1>(in_solids);
  }

  template <int dim>
  double
  FaceOpening<dim>::poured_fraction(const Vertices &v, const double held) const
  {
    if (emitter_distance.empty())
      return 0;
    constexpr double rounding = 1e-12;
    const double     poured   = held - solid_fraction(v);
    return poured > rounding ? poured : 0;
  }

  template <int dim>
  double
  FaceOpening<dim>::poured_in_solids(const LocalIndex f) const
  {
    const Vertices v = vertices(f);
    return fraction_within<dim - 1>(v.solid) - solid_fraction(v);
  }

  template <int dim>
  std::pair<double, double>
  FaceOpening<dim>::operator()(const LocalIndex f) const
  {
    const Vertices        v = vertices(f);
    VertexValues<dim - 1> open, held;
    for (unsigned int i = 0; i < dim; ++i)
      {
        held[i] = std::min(v.solid[i], v.emitter[i]);
        open[i] = -held[i];
      }
    const bool       is_wall  = mesh.face_side[f] != Mesh<dim>::no_side;
    constexpr double slit     = 1e-4; // there the least error of what the others carry would shoot
    const double     fraction = negative_fraction<dim - 1>(open), open_fraction = is_wall || fraction < slit ? 0 : fraction;
    if (open_fraction == 1)
      return {1, 0};
    // at the centroid the flux of a rigid motion is exact, and what the held parts of
    // a cell's faces carry balances but for the area between them
    const Point<dim>      centre      = negative_centroid<dim>(v.x, held);
    const Tensor<1, dim> &normal      = mesh.face_normal[f];
    const double          held_part   = fraction_within<dim - 1>(held), poured = poured_fraction(v, held_part);
    if (held_part == 0)
      return {open_fraction, 0};
    const double by_emitters = poured > 0 ? scene.emitter_velocity(centre, time) * normal : 0.;
    double       by_solids   = poured < held_part ? scene.solid_velocity(centre, time) * normal : 0.;
    if (is_wall && *std::min_element(v.solid.begin(), v.solid.end()) >= 0)
      by_solids = std::min(0., by_solids); // what lies along a wall may come in, but leaves that behind
    const double velocity = by_solids + poured / held_part * (by_emitters - by_solids);
    return {open_fraction, is_wall ? held_part * velocity : velocity}; // the rest of a wall is at rest
  }

  template class FaceOpening<2>;
  template class FaceOpening<3>;
} // namespace treacle
