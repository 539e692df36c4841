// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/fields/liquid_volume.h>
#include <treacle/fields/moved_points.h>
#include <treacle/surface/air_pockets.h>
#include <treacle/surface/marker_correction.h>
#include <treacle/surface/marker_seeding.h>
#include <treacle/surface/redistance.h>
#include <treacle/surface/stray_markers.h>
#include <treacle/surface/surface_tracking.h>

#include <numeric>

namespace treacle
{
  template <int dim>
  void
  SurfaceTracking<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Surface tracking");
    add_choice<Method>(prm,
                       "Method",
                       method,
                       "What follows the surface: a level set, corrected by markers that are "
                       "carried along or not. Markers keep thin parts, edges and volume.",
                       {{"marker level set", Method::marker_level_set},
                        {"level set", Method::level_set}});
    prm.add_parameter("Markers per cell",
                      markers_per_cell,
                      "Mean number of markers in a cell that the surface cuts: by default 12 in 2D, 3 "
                      "in 3D, where a leaf has more such cells.",
                      Patterns::Integer(1, 1000));
    prm.add_parameter("Volume correction",
                      volume_correction,
                      "Move the surface along its normal, evenly for each body and each thin part of "
                      "one, so that the volume stays what it was at the start.");
    prm.leave_subsection();
  }

  namespace
  {
    template <int dim>
    std::unique_ptr<const SurfaceGeometry<dim>>
    surface_of(const State<dim> &state)
    {
      return std::make_unique<const SurfaceGeometry<dim>>(state.mesh, state.phi);
    }
  } // namespace

  template <int dim>
  std::unique_ptr<const SurfaceGeometry<dim>>
  SurfaceTracking<dim>::begin(State<dim> &state, const MeshData<dim> &data) const
  {
    auto surface = surface_of(state);
    reseed(state, data.scene, *surface);
    if (!has_markers())
      return surface;
    MarkerCorrection<dim>(state).fill_thin_parts(state, data);
    surface = surface_of(state);
    reseed(state, data.scene, *surface);
    MarkerCorrection<dim>(state).fill_chords(state, data, surface->level_set);
    return surface_of(state);
  }

  template <int dim>
  void
  SurfaceTracking<dim>::follow_markers(State<dim>          &state,
                                       const MeshData<dim> &data,
                                       const double         dt,
                                       const double         reach) const
  {
    if (!has_markers())
      {
        state.markers.clear();
        redistance(state, reach, data.solid_distance(state.time));
        close_air_pockets(state, data, dt, reach);
        return;
      }
    MarkerCorrection<dim> markers(state);
    markers.apply(state);
    redistance(state, reach, data.solid_distance(state.time));
    markers.apply(state);
    markers.fill_thin_parts(state, data);
    close_air_pockets(state, data, dt, reach);
    // seeds settle on the smooth surface, where phi shows none on facets: these must be right in the mean, and only these
    const auto smooth = surface_of(state);
    const Guesses cells = remove_stray_markers(state, data.scene, *smooth, markers.cells(state));
    markers.fill_chords(state, data, smooth->level_set);
    reseed(state, data.scene, *smooth, cells);
  }

  template <int dim>
  std::unique_ptr<const SurfaceGeometry<dim>>
  SurfaceTracking<dim>::settle(State<dim>          &state,
                               const MeshData<dim> &data,
                               const double         volume,
                               const Parcels       &parcels) const
  {
    if (prm.volume_correction)
      correct_volume(state, data, volume, parcels);
    return surface_of(state);
  }

  template <int dim>
  void
  SurfaceTracking<dim>::reseed(State<dim>                 &state,
                               const Scene<dim>           &scene,
                               const SurfaceGeometry<dim> &surface,
                               const Guesses              &cells) const
  {
    if (has_markers())
      reseed_markers(state, scene, surface, prm.markers_per_cell, cells);
    else
      state.markers.clear();
  }

  namespace
  {
    /// Of what cells have that two parts share, which may be of either.
    constexpr double uncertain = 0.1;

    /// What each part is to have: what it @p received, as far as that is known, and of what all have in excess of that less a share by its area.
    template <int dim>
    std::vector<double>
    shares(const double excess, const std::vector<double> &received, const typename LiquidParts<dim>::Measures &now)
    {
      std::vector<double> wanted = now.volume;
      for (std::size_t k = 0; k < wanted.size(); ++k)
        {
          const double missing = received[k] - now.volume[k], doubt = uncertain * now.shared[k];
          wanted[k] += missing - std::clamp(missing, -doubt, doubt);
        }
      const auto   sum  = [](const std::vector<double> &values) { return std::accumulate(values.begin(), values.end(), 0.); };
      const double rest = sum(now.volume) - sum(wanted) - excess, area = sum(now.area);
      for (std::size_t k = 0; k < wanted.size(); ++k)
        wanted[k] += area > 0 ? rest * now.area[k] / area : 0;
      return wanted;
    }

    /// By how much to move the surface of each part inwards, after an @p offset (m): the derivative of the volume is the area. A lost drop
    /// must not blow up the rest in one step, so no offset becomes larger than @p largest, and what is thinner than that, and was moved too far, comes
    /// half the way back at most; what one part cannot have so, the others have by their area.
    template <int dim>
    std::vector<double>
    newton_step(const typename LiquidParts<dim>::Measures &now,
                const std::vector<double>                 &wanted,
                const std::vector<double>                 &offset,
                const double                               largest)
    {
      std::vector<double> change(offset.size(), 0);
      double              left = 0, area = 0;
      const auto          move = [&](const std::size_t k, const double volume) {
        const double old = change[k], halfway = volume * offset[k] < 0 ? 0.5 * offset[k] : 0.;
        change[k]        = std::clamp(offset[k] + old + volume / now.area[k],
                               halfway > 0 ? halfway : -largest,
                               halfway < 0 ? halfway : largest) -
                    offset[k];
        return volume - (change[k] - old) * now.area[k];
      };
      for (std::size_t k = 0; k < change.size(); ++k)
        if (now.area[k] > 0)
          {
            left += move(k, now.volume[k] - wanted[k]);
            area += std::abs(offset[k] + change[k]) < largest ? now.area[k] : 0.;
          }
      for (std::size_t k = 0; k < change.size(); ++k)
        if (now.area[k] > 0 && std::abs(offset[k] + change[k]) < largest)
          move(k, left * now.area[k] / area);
      return change;
    }
  } // namespace

  template <int dim>
  void
  SurfaceTracking<dim>::correct_volume(State<dim>          &state,
                                       const MeshData<dim> &data,
                                       const double         volume,
                                       const Parcels       &parcels) const
  {
    const LiquidParts<dim> parts(data, state.phi, state.time);
    std::vector<double>    wanted = {volume};
    auto                   now    = parts.measures();
    if (parts.size() > 1)
      wanted = shares<dim>(liquid_volume(data, state.phi, state.time) - volume, parts.received(parcels()), now);
    const double        largest = 0.1 * data.mesh.finest_size();
    std::vector<double> offset(parts.size(), 0);
    for (unsigned int round = 0; round < 2 && parts.size() > 0; ++round)
      {
        if (round > 0)
          now = parts.measures(state.phi);
        const std::vector<double> change = newton_step<dim>(now, wanted, offset, largest);
        state.phi.zero_out_ghost_values();
        for (LocalIndex node = 0; node < data.mesh.n_owned_nodes(); ++node)
          state.phi.local_element(node) += parts.at_node(node, change);
        state.phi.update_ghost_values();
        std::transform(offset.begin(), offset.end(), change.begin(), offset.begin(), std::plus<double>());
      }
    if (parts.size() > 0)
      {
        const std::vector<double> by = parts.at(positions(state.markers), offset);
        for (unsigned int k = 0; k < by.size(); ++k)
          state.markers[k].position -= by[k] * state.markers[k].normal;
      }
    state.markers = to_owners(data.mesh, state.markers);
  }

  template class SurfaceTracking<2>;
  template class SurfaceTracking<3>;
} // namespace treacle
