// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_measures_h
#define treacle_dynamics_measures_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Kinetic energy and momenta, from face or from node velocities.
  template <int dim>
  struct Motion
  {
    static constexpr unsigned int n_rotations = dim == 2 ? 1 : 3;

    double                          kinetic_energy = 0; ///< J
    std::array<double, dim>         linear{};           ///< kg m/s
    std::array<double, n_rotations> angular{}; ///< about the centre of mass, kg m^2/s
  };

  /// Integrals over the liquid, and its extent.
  template <int dim>
  struct Measures
  {
    double      volume = 0;           ///< m^dim
    Point<dim>  centre_of_mass;       ///< m; not a number without liquid
    Point<dim>  lower, upper;         ///< smallest box (m); not a number without liquid
    double      potential_energy = 0; ///< from the box's lower corner, J
    double      dissipation      = 0; ///< by viscosity, W
    double      maximum_speed    = 0; ///< of nodes in the liquid, m/s; not a number if one is none
    Motion<dim> of_faces, of_nodes;
  };

  /// Throws a UserError on all ranks where gravity is not finite. Collective.
  template <int dim>
  Measures<dim>
  measure(const State<dim> &state, const LiquidDomain<dim> &domain);
} // namespace treacle

#endif
