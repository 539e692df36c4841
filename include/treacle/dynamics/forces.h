// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_forces_h
#define treacle_dynamics_forces_h

#include <treacle/base/exchange.h>
#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Body force: `u += step g·n` in the mean over the liquid part of the dual edges of liquid faces, by two points after Gauss. There
  /// a force that has a potential is the difference of that, so that pressure holds it; at the barycentres of faces, through which dual
  /// edges need not go, a formula with x in it would stir liquid that should rest.
  template <int dim>
  class Forces
  {
  public:
    void
    advance(State<dim> &state, const LiquidDomain<dim> &domain, const double step) const
    {
      const Mesh<dim> &mesh = domain.mesh;
      std::string      error;
      for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
        if (domain.is_liquid_face(f))
          keep_error(error, [&] {
            const auto g = [&](const Point<dim> &x) { return domain.scene.gravity(x, state.time) * mesh.face_normal[f]; };
            state.u.local_element(f) += step * domain.liquid_part(f, domain.theta[f]).mean(g);
          });
      throw_first(mesh.communicator(), error);
      state.u.update_ghost_values();
    }
  };
} // namespace treacle

#endif
