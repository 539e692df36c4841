// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_xdmf_h
#define treacle_io_xdmf_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Write the mesh and its fields as `<name>.h5` and enter it in `mesh.xdmf`,
  /// behind the names before it that are listed there. Throws a UserError on all
  /// ranks where that fails. Collective.
  template <int dim>
  void
  write_xdmf(const State<dim>        &state,
             const LiquidDomain<dim> &domain,
             const std::string       &directory,
             const std::string       &name);
} // namespace treacle

#endif
