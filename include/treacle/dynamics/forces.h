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
      std::string error;
      for (LocalIndex f = 0; f < domain.mesh.n_owned_faces(); ++f)
        if (domain.is_liquid_face(f))
          keep_error(error, [&] { state.u.local_element(f) += step * along_dual_edge(domain, f, state.time); });
      throw_first(domain.mesh.communicator(), error);
      state.u.update_ghost_values();
    }

  private:
    /// Of gravity (m/s^2).
    static double
    along_dual_edge(const LiquidDomain<dim> &domain, const LocalIndex f, const double time)
    {
      const Mesh<dim> &mesh           = domain.mesh;
      const auto &[first, second]     = mesh.face_cells[f];
      const bool           from_first = domain.is_pressure_cell[first], is_whole = from_first == domain.is_pressure_cell[second];
      const Tensor<1, dim> edge       = (is_whole ? 1 : domain.theta[f]) * mesh.face_dual_length[f] * mesh.face_normal[f];
      const Point<dim>     middle =
        from_first || is_whole ? mesh.cell_dual[first] + 0.5 * edge : mesh.cell_dual[second] - 0.5 * edge;
      const Tensor<1, dim> to_point = edge / (2 * std::sqrt(3.));
      const auto           g = [&](const Point<dim> &x) { return domain.scene.gravity(x, time) * mesh.face_normal[f]; };
      return 0.5 * (g(middle - to_point) + g(middle + to_point));
    }
  };
} // namespace treacle

#endif
