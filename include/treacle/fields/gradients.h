// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_gradients_h
#define treacle_fields_gradients_h

#include <treacle/mesh/mesh.h>

namespace treacle
{
  /// Of the node velocity v in a cell (1/s): [component][direction].
  template <int dim>
  Tensor<2, dim>
  velocity_gradient(const Mesh<dim> &mesh, const LocalIndex cell, const NodeVector<dim> &v)
  {
    Tensor<2, dim> result;
    for (unsigned int i = 0; i <= dim; ++i)
      result += outer_product(v.value(mesh.cell_nodes[cell][i]), mesh.cell_gradients[cell][i]);
    return result;
  }
} // namespace treacle

#endif
