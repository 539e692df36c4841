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
                      "Move the surface evenly along its normal so that the volume stays what it "
                      "was at the start.");
    prm.leave_subsection();
  }

  namespace
  {
    /// Area of phi = 0 over all ranks (m^(dim-1)).
    template <int dim>
    double
    surface_area(const State<dim> &state)
    {
      double area = 0;
      for (LocalIndex c = 0; c < state.mesh->n_owned_cells(); ++c)
        for_each_facet(*state.mesh, state.phi, c, [&](const auto &x) {
          area += area_vector<dim>(x).norm();
        });
      return Utilities::MPI::sum(area, state.mesh->communicator());
    }

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
        redistance(state, reach);
        close_air_pockets(state, data, dt, reach);
        return;
      }
    MarkerCorrection<dim> markers(state);
    markers.apply(state);
    redistance(state, reach);
    markers.apply(state);
    markers.fill_thin_parts(state, data);
    close_air_pockets(state, data, dt, reach);
    // seeds settle on the smooth surface, where phi shows none on facets: these must be right in the mean, and only these
    const auto smooth = surface_of(state);
    remove_stray_markers(state, data.scene, *smooth);
    markers.fill_chords(state, data, smooth->level_set);
    reseed(state, data.scene, *smooth);
  }

  template <int dim>
  std::unique_ptr<const SurfaceGeometry<dim>>
  SurfaceTracking<dim>::settle(State<dim> &state, const MeshData<dim> &data, const double volume) const
  {
    if (prm.volume_correction)
      correct_volume(state, data, volume);
    return surface_of(state);
  }

  template <int dim>
  void
  SurfaceTracking<dim>::reseed(State<dim>                 &state,
                               const Scene<dim>           &scene,
                               const SurfaceGeometry<dim> &surface) const
  {
    if (has_markers())
      reseed_markers(state, scene, surface, prm.markers_per_cell);
    else
      state.markers.clear();
  }

  template <int dim>
  void
  SurfaceTracking<dim>::correct_volume(State<dim>          &state,
                                       const MeshData<dim> &data,
                                       const double         volume) const
  {
    // Newton's method: the derivative of the volume is the area. A lost drop
    // must not blow up the rest in one step, hence the bound.
    const double largest = 0.1 * data.mesh.finest_size();
    double       offset  = 0;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const double area = surface_area(state);
        if (area == 0)
          break;
        const double wanted =
          offset + (liquid_volume(data, state.phi, state.time) - volume) / area;
        const double change = std::min(std::max(wanted, -largest), largest) - offset;
        offset += change;
        state.phi.zero_out_ghost_values();
        state.phi.add(change);
        state.phi.update_ghost_values();
      }
    for (Marker<dim> &marker : state.markers)
      marker.position -= offset * marker.normal;
    state.markers = to_owners(data.mesh, state.markers);
  }

  template class SurfaceTracking<2>;
  template class SurfaceTracking<3>;
} // namespace treacle
