// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_schur_complement_h
#define treacle_dynamics_schur_complement_h

#include <treacle/pressure/pressure_system.h>
#include <treacle/viscosity/hybrid.h>

namespace treacle
{
  /// Of Stokes for the pressure, approximated as in Cahouet & Chabard (1988): its inverse is the sum of
  /// those of the projection's matrix `B M^-1 B^T`, which it is without viscosity, and of
  /// `V / (2 mu step) + B (1 - s) M^-1 B^T`, which it comes to where viscosity rules.
  template <int dim>
  class SchurComplement
  {
  public:
    /// The systems must outlive this object.
    SchurComplement(const PressureSystem<dim> &pressure, const Hybrid<dim> &hybrid, const double step);

    SchurComplement(const SchurComplement &) = delete;

    /// z is the inverse times r. Collective.
    void
    invert(Vector &z, const Vector &r) const;

    /// The same of diagonals alone.
    Vector
    inverse_diagonal() const;

  private:
    /// Of a cell (Pa s): pressure does not shear it, so that where viscosity jumps kinks of the velocity do not make it softer than the mean.
    double
    viscosity_felt(const LocalIndex cell) const;

    std::unique_ptr<const TrilinosWrappers::SparseMatrix>
    viscous_part(const Hybrid<dim> &hybrid) const;

    /// Does it act far across the liquid in a step, wherever that is thinnest? What inertia does is felt
    /// by waves of the pressure longer than that alone: a few, by a factor of ten or some tens.
    bool
    viscosity_rules() const;

    const PressureSystem<dim>                                  &pressure;
    const LiquidDomain<dim>                                    &domain;
    const double                                                step;
    const bool                                                  needs_projection;
    const std::unique_ptr<const TrilinosWrappers::SparseMatrix> viscous;
    TrilinosWrappers::PreconditionChebyshev                     viscous_inverse;
    mutable Vector                                              z_projection; ///< scratch
  };
} // namespace treacle

#endif
