// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/stray_markers.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    bool
    is_on_box(const Mesh<dim> &mesh, const Point<dim> &x)
    {
      const auto  &box       = mesh.box();
      const double tolerance = 1e-6 * mesh.finest_size();
      for (unsigned int d = 0; d < dim; ++d)
        if (x[d] < box.lower_bound(d) + tolerance || x[d] > box.upper_bound(d) - tolerance)
          return true;
      return false;
    }

    void
    check_lost(const MPI_Comm    &comm,
               const unsigned int n_lost,
               const unsigned int n_markers,
               const double       time)
    {
      const unsigned int lost  = Utilities::MPI::sum(n_lost, comm);
      const unsigned int total = Utilities::MPI::sum(n_markers, comm);
      require(2 * lost <= total,
              "Surface tracking: " + std::to_string(lost) + " of " + std::to_string(total) +
                " markers are further than a leaf from the surface at t = " + digits(time) +
                " s. Lower Maximum CFL number or Maximum time step, or raise Mesh/Surface level.");
    }
  } // namespace

  template <int dim>
  void
  remove_stray_markers(State<dim>                 &state,
                       const Scene<dim>           &scene,
                       const SurfaceGeometry<dim> &surface)
  {
    const Mesh<dim> &mesh   = *state.mesh;
    Guesses                  cells;
    const auto               samples = surface.level_set.samples(positions(state.markers), cells);
    std::vector<Marker<dim>> kept;
    unsigned int             n_lost = 0;
    for (unsigned int k = 0; k < samples.size(); ++k)
      {
        const Marker<dim>  &marker    = state.markers[k];
        const double        h         = surface_size_of_cell(mesh, cells[k]);
        const double        phi       = samples[k].value;
        const bool          is_smooth = samples[k].smoothness > 0.9;
        const Tensor<1, dim> gradient = samples[k].gradient;
        // in the liquid two surfaces may have met; but air around a marker, or no
        // number, says that the surface was lost
        n_lost += !(phi < h);
        if (!(std::abs(phi) < 0.75 * h) || is_on_box(mesh, marker.position) ||
            (is_smooth && gradient * marker.normal < 0) ||
            (scene.has_solids() && scene.solid_distance(marker.position, state.time) < 0))
          continue;
        kept.push_back(marker);
        if (is_smooth && gradient.norm() > 0)
          kept.back().normal = gradient / gradient.norm();
      }
    // where nothing is left, as of a film that withered, there is nothing to follow
    const MPI_Comm &comm = mesh.communicator();
    if (Utilities::MPI::max(surface.facets.facets.empty() ? 0 : 1, comm) > 0)
      check_lost(comm, n_lost, state.markers.size(), state.time);
    state.markers = std::move(kept);
  }

  template void
  remove_stray_markers(State<2> &, const Scene<2> &, const SurfaceGeometry<2> &);
  template void
  remove_stray_markers(State<3> &, const Scene<3> &, const SurfaceGeometry<3> &);
} // namespace treacle
