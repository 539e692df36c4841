// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_surface_tracking_h
#define treacle_surface_surface_tracking_h

#include <treacle/fields/mesh_data.h>
#include <treacle/surface/liquid_parts.h>
#include <treacle/surface/surface_geometry.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>

namespace treacle
{
  /// Mends phi after it was advected: its place by the markers, distances, air that is enclosed, and the volume.
  template <int dim>
  class SurfaceTracking
  {
  public:
    enum class Method
    {
      marker_level_set,
      level_set
    };

    struct Parameters
    {
      Method       method            = Method::marker_level_set;
      unsigned int markers_per_cell  = dim == 2 ? 12 : 3;
      bool         volume_correction = true;

      void
      add_parameters(ParameterHandler &prm);
    };

    explicit SurfaceTracking(const Parameters &parameters)
      : prm(parameters)
    {}

    /// The surface of a state that has phi alone, which gets its markers, and thin parts their volume.
    std::unique_ptr<const SurfaceGeometry<dim>>
    begin(State<dim> &state, const MeshData<dim> &data) const;

    /// @p state has phi and markers of the new time, which correct it, thin air that a step @p dt (s) like
    /// this one fills becomes liquid, and markers come where there are too few. Distances within @p reach (m).
    void
    follow_markers(State<dim> &state, const MeshData<dim> &data, const double dt, const double reach) const;

    /// The liquid of a step, as it has come to where it is now, or would be if there were no walls, on whichever rank. Collective; only asked for where there are
    /// several parts.
    using Parcels = std::function<std::vector<Parcel<dim>>()>;

    /// The surface, with volume correction moved to restore @p volume (m^dim), with its markers: of each part of the liquid what has come to it, and an even part of
    /// what is missing in all.
    std::unique_ptr<const SurfaceGeometry<dim>>
    settle(State<dim> &state, const MeshData<dim> &data, const double volume, const Parcels &parcels) const;

    /// One after the other, after a move that takes no time.
    std::unique_ptr<const SurfaceGeometry<dim>>
    advance(State<dim>          &state,
            const MeshData<dim> &data,
            const double         reach,
            const double         volume,
            const Parcels       &parcels) const
    {
      follow_markers(state, data, 0, reach);
      return settle(state, data, volume, parcels);
    }

    /// Markers, if there are to be any, on a surface that has too few. With guesses for the @p cells of those that there are.
    void
    reseed(State<dim> &state, const Scene<dim> &scene, const SurfaceGeometry<dim> &surface, const Guesses &cells = {}) const;

    bool
    keeps_volume() const
    {
      return prm.volume_correction;
    }

  private:
    bool
    has_markers() const
    {
      return prm.method == Method::marker_level_set;
    }

    void
    correct_volume(State<dim> &state, const MeshData<dim> &data, const double volume, const Parcels &parcels) const;

    const Parameters prm;
  };
} // namespace treacle

#endif
