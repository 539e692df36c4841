// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_pressure_projection_h
#define treacle_pressure_projection_h

#include <treacle/pressure/pressure_system.h>

namespace treacle
{
  /// Pressure projection: the face velocity of least kinetic energy
  /// `1/2 |u - u*|^2 in M_f` whose divergence vanishes in every pressure cell.
  template <int dim>
  class Projection
  {
  public:
    struct Parameters
    {
      LinearSolver::Parameters solver{LinearSolver::Preconditioner::amg, 1e-8, 1000};

      void
      add_parameters(ParameterHandler &prm)
      {
        solver.add_parameters(prm, "Pressure");
      }
    };

    /// The system must outlive this object.
    explicit Projection(const PressureSystem<dim> &system)
      : system(system)
    {}

    /// Is a projection the first of its step, or does it correct an earlier one?
    enum class Pass
    {
      first,
      correction
    };

    /// Make state.u free of divergence; sets state.pressure, or adds to it in a
    /// correction. In a pocket without a free surface the mean of the pressure is 0.
    /// The pressure acts over @p step (s). Returns the number of iterations.
    unsigned int
    advance(State<dim> &state, const double step, const Pass pass) const;

    /// Add to u the flow of least kinetic energy that carries away what comes into the pressure
    /// cells, @p inflow (m^dim/s), one entry a cell; in a pocket without a free surface, what is
    /// left once the mean is taken off.
    void
    carry_away(Vector &u, const Vector &inflow) const;

  private:
    const PressureSystem<dim> &system;
  };
} // namespace treacle

#endif
