// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_dual_weights_h
#define treacle_mesh_dual_weights_h

#include <treacle/mesh/mesh_file.h>

namespace treacle
{
  /// Of the way from barycentre to barycentre along the normal of a face: dual lengths below that are clamped.
  constexpr double least_dual_length = 1e-2;

  /// Weights of the vertices (m^2) of a mesh from a file, with which its dual edges are long: at least a tenth of the way between barycentres if it has such
  /// weights, else as far above least_dual_length as can be found, and with no weights around those for which none can. All are 0 where circumcentres alone do that. A dual
  /// length is linear in the weights of the vertices of its two cells; those that are too short get long enough one after the other by the
  /// smallest change of weights, again and again (relaxation, Agmon 1954, Motzkin & Schoenberg 1954). A mesh that is not the
  /// regular triangulation of any weights keeps some that are clamped.
  template <int dim>
  std::vector<double>
  dual_weights(const MeshFile<dim> &file);
} // namespace treacle

#endif
