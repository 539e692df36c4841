// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_liquid_h
#define treacle_tests_liquid_h

#include <treacle/fields/liquid_domain.h>

namespace tests
{
  using namespace treacle;

  /// Where the liquid of a state is.
  template <int dim>
  struct WhereLiquidIs
  {
    WhereLiquidIs(const State<dim> &state, const Scene<dim> &scene)
      : data(*state.mesh, scene)
      , domain({LiquidDomain<dim>::Hold::walls, 0.01}, state, data)
    {}

    const MeshData<dim>     data;
    const LiquidDomain<dim> domain;
  };
} // namespace tests

#endif
