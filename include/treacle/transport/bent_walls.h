// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_bent_walls_h
#define treacle_transport_bent_walls_h

#include <treacle/scene/scene.h>

namespace treacle
{
  /// Do leaves of a cube's size fail to show where the walls of solids are in it, as at edges and in plates and gaps thinner than they are: by
  /// more than 0.4 of the @p finest (m)? While leaves grow, by a quarter, in any such cube half an edge away.
  template <int dim>
  bool
  walls_bend_in(const Scene<dim> &scene,
                const Point<dim> &centre,
                const double      edge,
                const double      finest,
                const double      time,
                const bool        while_growing);
} // namespace treacle

#endif
