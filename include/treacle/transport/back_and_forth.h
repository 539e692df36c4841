// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_back_and_forth_h
#define treacle_transport_back_and_forth_h

#include <treacle/mesh/tracer.h>

namespace treacle
{
  /// Half of what node fields f lose when @p velocity carries them on by @p dt and back
  /// again, `e = (f - f_back_and_forth)/2`. Semi-Lagrangian advection of f + e is of
  /// second order in the mesh size, see NodeField::correction. Values are known at the
  /// owned nodes @p known and taken as constant in time elsewhere; e is zero but at
  /// @p corrected. Ghosts must be and are up to date. Collective.
  template <int dim>
  std::vector<Vector>
  back_and_forth_error(const Mesh<dim>                   &mesh,
                       const std::vector<const Vector *> &fields,
                       const VelocityInStep<dim>         &velocity,
                       const double                       dt,
                       const std::vector<LocalIndex>     &known,
                       const std::vector<LocalIndex>     &corrected);
} // namespace treacle

#endif
