// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_node_vector_h
#define treacle_mesh_node_vector_h

#include <treacle/base/types.h>

#include <deal.II/base/partitioner.h>

#include <memory>

namespace treacle
{
  /// A vector (velocity, gradient) at each node, component by component.
  template <int dim>
  struct NodeVector
  {
    std::array<Vector, dim> component;

    /// Zero.
    explicit NodeVector(const std::shared_ptr<const Utilities::MPI::Partitioner> &nodes)
    {
      for (Vector &v : component)
        v.reinit(nodes);
    }

    /// The same value everywhere, ghosts too. Collective.
    NodeVector(const std::shared_ptr<const Utilities::MPI::Partitioner> &nodes, const double value)
      : NodeVector(nodes)
    {
      for (Vector &v : component)
        v = value;
      update_ghost_values();
    }

    Tensor<1, dim>
    value(const LocalIndex node) const
    {
      Tensor<1, dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = component[d].local_element(node);
      return x;
    }

    void
    set(const LocalIndex node, const Tensor<1, dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        component[d].local_element(node) = x[d];
    }

    void
    update_ghost_values() const
    {
      for (const Vector &v : component)
        v.update_ghost_values();
    }
  };
} // namespace treacle

#endif
