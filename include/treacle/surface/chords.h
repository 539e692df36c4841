// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_chords_h
#define treacle_surface_chords_h

#include <treacle/fields/mesh_data.h>

namespace treacle
{
  /// By how much @p phi, which is linear in cells, is above the smooth function with its values and the nodal @p gradient
  /// (fields/gradients.h), in the mean over the cells around each owned node within @p deep leaves of phi = 0 (m; elsewhere 0). The
  /// chords of a surface of mean curvature kappa (the sum of the principal ones) lie by about h^2 kappa / 20 inside it, in 2D / 16.
  /// Collective.
  template <int dim>
  std::vector<double>
  heights_above_chords(const MeshData<dim> &data, const Vector &phi, const NodeVector<dim> &gradient, const double deep);
} // namespace treacle

#endif
