// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_state_h
#define treacle_fields_state_h

#include <treacle/fields/marker.h>
#include <treacle/mesh/mesh.h>

#include <memory>

namespace treacle
{
  /// All that evolves. Every step leaves the ghosts of what it changed up to date.
  template <int dim>
  struct State
  {
    /// At rest and without liquid.
    explicit State(std::shared_ptr<const Mesh<dim>> mesh)
      : mesh(std::move(mesh))
      , phi(this->mesh->nodes)
      , u(this->mesh->faces)
      , v(this->mesh->nodes)
      , pressure(this->mesh->cells)
    {}

    std::shared_ptr<const Mesh<dim>> mesh;

    double       time = 0; ///< s
    unsigned int step = 0;

    Vector            phi;      ///< level set at nodes (m)
    Vector            u;        ///< face velocity, along the face's normal (m/s)
    NodeVector<dim>   v;        ///< node velocity, for tracing and output (m/s)
    Vector            pressure; ///< at dual centres, of the last projection (Pa)

    /// Each on the rank that owns the leaf it lies in; none without marker level set.
    std::vector<Marker<dim>> markers;
  };
} // namespace treacle

#endif
