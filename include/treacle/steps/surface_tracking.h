// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_steps_surface_tracking_h
#define treacle_steps_surface_tracking_h

#include <treacle/fields/liquid_domain.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// Mends phi after it was advected: distances, and the volume.
  template <int dim>
  class SurfaceTracking
  {
  public:
    struct Parameters
    {
      std::string method            = "level set";
      bool        volume_correction = true;

      void
      add_parameters(ParameterHandler &prm);
    };

    explicit SurfaceTracking(const Parameters &parameters)
      : prm(parameters)
    {}

    /// Distances within @p reach (m); with volume correction an offset of phi
    /// that restores @p volume (m^dim).
    void
    advance(State<dim> &state, const Scene<dim> &scene, const double reach, const double volume) const;

  private:
    const Parameters prm;
  };
} // namespace treacle

#endif
