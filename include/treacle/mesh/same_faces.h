// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_same_faces_h
#define treacle_mesh_same_faces_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Of the @p faces of another mesh of the same box, those that @p mesh has as well have its @p values, along their own normals; others what is
  /// for the @p missing. Ghosts are up to date. Collective.
  template <int dim>
  std::vector<double>
  values_of_same_faces(const Mesh<dim>               &mesh,
                       const Vector                  &values,
                       const Mesh<dim>               &other,
                       const std::vector<LocalIndex> &faces,
                       const double                   missing);
} // namespace treacle

#endif
