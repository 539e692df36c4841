// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/marker_sheet.h>
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
        if (x[d] < box.lower_bound(d) + tolerance ||
            x[d] > box.upper_bound(d) - tolerance)
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
      require(
        2 * lost <= total,
        "Surface tracking: " + std::to_string(lost) + " of " + std::to_string(total) +
          " markers are further than a leaf from the surface at t = " + digits(time) +
          " s. Lower Maximum CFL number or Maximum time step, or raise Mesh/Surface level.");
    }
  } // namespace

  namespace
  {
    /// A marker, and phi there.
    template <int dim>
    struct MarkerInPhi
    {
      const Marker<dim>                          &marker;
      const typename SmoothLevelSet<dim>::Sample &phi;
      const double                                h; ///< size of leaves (m)

      bool
      is_within(const double leaves) const
      {
        return std::abs(phi.value) < leaves * h;
      }

      bool
      is_smooth() const
      {
        return phi.smoothness > 0.9;
      }

      bool
      is_turned() const
      {
        return is_smooth() && phi.gradient * marker.normal < 0;
      }

      /// Is it on an ordinary surface, with nothing else about?
      bool
      is_plain() const
      {
        return phi.smoothness > 0.999 && is_within(0.75) && !is_turned();
      }
    };

    /// What a marker is with regard to the sheet of those around that face the other way.
    enum class Side
    {
      single,
      of_film, ///< up to 1.1 leaves thick
      crossed  ///< that sheet runs through it
    };

    template <int dim>
    Side
    side(const Marker<dim> &marker, const AroundPoint<dim> &near, const double h)
    {
      const auto opposed = facing<dim>(near, -marker.normal, 0.3);
      if (opposed.empty())
        return Side::single;
      const MarkerSheet<dim> sheet(marker.position, {opposed.data(), opposed.size()}, h);
      const double           thickness = -sheet.distance / h; // of liquid
      if (sheet.is_beside || thickness < -0.1 || thickness > 1.1)
        return Side::single;
      return thickness > 0.1 ? Side::of_film : Side::crossed;
    }

    template <int dim>
    class Strays
    {
    public:
      Strays(const State<dim>                    &state,
             const Scene<dim>                    &scene,
             const std::vector<MarkerInPhi<dim>> &all)
        : state(state)
        , scene(scene)
        , sheets(*state.mesh, not_plain(all), MarkerSheet<dim>::reach)
      {}

      /// Append a marker unless it is a stray one, with phi's normal where phi knows it. Does it stay?
      bool
      keep(const MarkerInPhi<dim> &at, std::vector<Marker<dim>> &kept)
      {
        const Side side       = side_of(at);
        const bool is_of_film = side == Side::of_film;
        if (side == Side::crossed || !at.is_within(is_of_film ? 1 : 0.75) ||
            (at.is_turned() && !is_of_film) ||
            is_on_box(*state.mesh, at.marker.position) ||
            scene.is_in_solids(at.marker.position, state.time))
          return false;
        kept.push_back(at.marker);
        if (at.is_smooth() && !is_of_film && at.phi.gradient.norm() > 0)
          kept.back().normal = at.phi.gradient / at.phi.gradient.norm();
        return true;
      }

    private:
      static std::vector<Marker<dim>>
      not_plain(const std::vector<MarkerInPhi<dim>> &all)
      {
        std::vector<Marker<dim>> result;
        for (const MarkerInPhi<dim> &at : all)
          if (!at.is_plain())
            result.push_back(at.marker);
        return result;
      }

      Side
      side_of(const MarkerInPhi<dim> &at)
      {
        if (at.is_plain()) // most are, and to look around costs time
          return Side::single;
        near.clear();
        sheets.append_around(at.marker.position, at.h, near);
        return side<dim>(at.marker, {near.data(), near.size()}, at.h);
      }

      const State<dim>                    &state;
      const Scene<dim>                    &scene;
      const MarkersWithinLeaves<dim>       sheets;
      std::vector<const NearMarker<dim> *> near; ///< scratch
    };
  } // namespace

  template <int dim>
  Guesses
  remove_stray_markers(State<dim>                 &state,
                       const Scene<dim>           &scene,
                       const SurfaceGeometry<dim> &surface,
                       Guesses                     cells)
  {
    const Mesh<dim> &mesh = *state.mesh;
    const auto       samples = surface.level_set.samples(positions(state.markers), cells);
    std::vector<MarkerInPhi<dim>> all;
    unsigned int                  n_lost = 0;
    for (unsigned int k = 0; k < samples.size(); ++k)
      {
        const double h = surface_size_of_cell(mesh, cells[k]);
        all.push_back({state.markers[k], samples[k], h});
        // in the liquid two surfaces may have met; but air around a marker, or no
        // number, says that the surface was lost
        n_lost += !(samples[k].value < h);
      }
    Strays<dim>              strays(state, scene, all);
    std::vector<Marker<dim>> kept;
    for (unsigned int k = 0; k < all.size(); ++k)
      if (strays.keep(all[k], kept))
        cells[kept.size() - 1] = cells[k];
    cells.resize(kept.size());
    // where nothing is left, as of a film that withered, there is nothing to follow
    const MPI_Comm &comm = mesh.communicator();
    if (Utilities::MPI::max(surface.facets.facets.empty() ? 0 : 1, comm) > 0)
      check_lost(comm, n_lost, state.markers.size(), state.time);
    state.markers = std::move(kept);
    return cells;
  }

  template Guesses
  remove_stray_markers(State<2> &, const Scene<2> &, const SurfaceGeometry<2> &, Guesses);
  template Guesses
  remove_stray_markers(State<3> &, const Scene<3> &, const SurfaceGeometry<3> &, Guesses);
} // namespace treacle
