// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_mesh_fields_h
#define treacle_io_mesh_fields_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// One array at the nodes or in the cells, component by component.
  struct Field
  {
    std::string        name;
    unsigned int       n_components;
    std::vector<float> values;
  };

  /// Level set and velocity at these nodes. Vectors have three components.
  template <int dim>
  std::vector<Field>
  node_fields(const State<dim> &state, const std::vector<LocalIndex> &nodes);

  /// Pressure, viscosity, liquid fraction and rank in the owned cells.
  template <int dim>
  std::vector<Field>
  cell_fields(const State<dim> &state, const LiquidDomain<dim> &domain);

  /// Three coordinates a node.
  template <int dim>
  std::vector<double>
  positions(const Mesh<dim> &mesh, const std::vector<LocalIndex> &nodes);
} // namespace treacle

#endif
