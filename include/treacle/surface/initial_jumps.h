// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_initial_jumps_h
#define treacle_surface_initial_jumps_h

#include <treacle/fields/mesh_data.h>
#include <treacle/surface/material_property.h>

#include <functional>

namespace treacle
{
  /// Where a property jumps that is given by a formula, on planes in cells that are full of liquid: the mean at the nodes goes from one value to the other
  /// as their distance from the plane does, from a leaf before it to a leaf behind it, so that its middle lies on the plane. @p at_nodes has the formula's
  /// values at nodes in the liquid, NaN elsewhere. Elsewhere the mean is left alone. Returns 1 at the owned nodes about such jumps, else 0. Collective.
  template <int dim>
  Vector
  set_means_about_jumps(const MeshData<dim>                             &data,
                        const MaterialProperty<dim>                     &property,
                        const std::vector<double>                       &at_nodes,
                        const std::function<double(const Point<dim> &)> &formula);
} // namespace treacle

#endif
