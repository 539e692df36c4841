// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_forces_h
#define treacle_dynamics_forces_h

#include <treacle/base/exchange.h>
#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Body force: `u += step g·n` at the barycentres of liquid faces.
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
            state.u.local_element(f) +=
              step * (domain.scene.gravity(mesh.face_centre(f), state.time) * mesh.face_normal[f]);
          });
      throw_first(mesh.communicator(), error);
      state.u.update_ghost_values();
    }
  };
} // namespace treacle

#endif
