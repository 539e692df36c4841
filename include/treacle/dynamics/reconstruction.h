// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_reconstruction_h
#define treacle_dynamics_reconstruction_h

#include <treacle/viscosity/face_fit.h>

namespace treacle
{
  /// Node velocity, for tracing and output, from face velocity.
  template <int dim>
  class Reconstruction
  {
  public:
    enum class Method
    {
      face_fitted,
      least_squares,
      two_step
    };

    struct Parameters
    {
      Method method = Method::face_fitted;

      /// Subsection Advection.
      void
      add_parameters(ParameterHandler &prm);
    };

    explicit Reconstruction(const Parameters &parameters)
      : prm(parameters)
    {}

    /// Set state.v at active nodes. Where viscosity spreads hardly any momentum in a @p longest_step (s) the face fit
    /// slips along walls, see Slip.
    void
    advance(State<dim> &state, const FaceFit<dim> &fit, const double longest_step) const;

  private:
    const Parameters prm;
  };
} // namespace treacle

#endif
