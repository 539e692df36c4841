// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/initial_state.h>
#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/marker_seeding.h>
#include <treacle/surface/marker_sheet.h>
#include <treacle/surface/sowing.h>

namespace treacle
{
  namespace
  {
    /// Point k of an even sequence on a facet.
    template <int dim>
    Point<dim>
    even_point(const std::array<Point<dim>, dim> &facet,
               const double                       start,
               const unsigned int                 k)
    {
      std::array<double, dim - 1> s = treacle::even_point<dim - 1>(start, k);
      if (dim == 3 && s[0] + s[dim - 2] > 1)
        for (double &coordinate : s)
          coordinate = 1 - coordinate;
      Point<dim> x = facet[0];
      for (unsigned int i = 0; i + 1 < dim; ++i)
        x += s[i] * (facet[i + 1] - facet[0]);
      return x;
    }

    /// Area of a plane in a cell, the mean over all planes that cut one: volume over
    /// mean width, for a cell between two leaves of edge 1.
    template <int dim>
    constexpr double mean_facet_area = dim == 2 ? 0.3254 : 0.1007;

    template <int dim>
    class Seeding
    {
    public:
      Seeding(State<dim>                 &state,
              const Scene<dim>           &scene,
              const SurfaceGeometry<dim> &surface,
              const unsigned int          per_cell)
        : state(state)
        , mesh(*state.mesh)
        , scene(scene)
        , surface(surface)
        , per_cell(per_cell)
        , count(mesh.cells)
        , wanted(mesh.cells)
      {}

      void
      reseed(const Guesses &guesses)
      {
        measure_cells();
        count_markers(guesses);
        thin();
        add();
      }

    private:
      /// Markers per area.
      double
      density(const LocalIndex cell) const
      {
        return per_cell / (mean_facet_area<dim> *
                           std::pow(surface_size_of_cell(mesh, cell), dim - 1));
      }

      void
      measure_cells()
      {
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          for_each_facet(mesh, state.phi, c, [&](const auto &x) {
            wanted.local_element(c) += density(c) * area_vector<dim>(x).norm();
          });
        wanted.update_ghost_values();
      }

      void
      count_markers(Guesses guesses)
      {
        guesses.resize(state.markers.size(), invalid);
        const Locator<dim>      &locator = mesh.locator();
        std::vector<Marker<dim>> located;
        for (unsigned int k = 0; k < state.markers.size(); ++k)
          if (const LocalIndex cell = locator.locate_here(state.markers[k].position, guesses[k]).cell;
              cell != invalid)
            {
              located.push_back(state.markers[k]);
              cells.push_back(cell);
              count.local_element(cell) += 1;
            }
        state.markers = std::move(located);
        count.compress(VectorOperation::add);
        count.update_ghost_values();
      }

      void
      thin()
      {
        std::vector<Marker<dim>> kept;
        for (unsigned int k = 0; k < cells.size(); ++k)
          {
            const double target = wanted.local_element(cells[k]);
            if (target == 0 || stays(mesh,
                                     state.markers[k].position,
                                     count.local_element(cells[k]),
                                     target))
              kept.push_back(state.markers[k]);
          }
        state.markers = std::move(kept);
      }

      void
      add()
      {
        std::vector<Marker<dim>> seeds;
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          {
            const double target = wanted.local_element(c);
            if (target == 0 || count.local_element(c) >= 0.5 * target)
              continue;
            const double start   = start_of_seeds(mesh, c);
            double       missing = target - count.local_element(c), part = start;
            for_each_facet(mesh, state.phi, c, [&](const auto &x) {
              const Tensor<1, dim> area = area_vector<dim>(x);
              if (area.norm() == 0)
                return;
              part += missing * density(c) * area.norm() / target;
              for (unsigned int k = 1; part >= 1; part -= 1, ++k)
                seeds.push_back({even_point<dim>(x, start, k), area / area.norm()});
            });
          }
        project(seeds);
        seeds = to_owners(mesh, seeds); // who know how large leaves are
        if (state.step == 0)
          {
            project_to_bodies(seeds);
            seeds = to_owners(mesh, seeds);
          }
        keep_in_line(seeds);
        state.markers.insert(state.markers.end(), seeds.begin(), seeds.end());
      }

      /// Where markers are about, they know better than phi where a surface runs. Seeds
      /// on the ragged facets of a thin part that phi cannot hold would lie inside it,
      /// and thin it.
      void
      keep_in_line(std::vector<Marker<dim>> &seeds) const
      {
        const MarkersWithinLeaves<dim>       markers(mesh,
                                               state.markers,
                                               MarkerSheet<dim>::reach);
        std::vector<Marker<dim>>             kept;
        std::vector<const NearMarker<dim> *> near;
        for (Marker<dim> &seed : seeds)
          {
            const double h = size_at(seed.position);
            near.clear();
            markers.append_around(seed.position, h, near);
            if (settles({near.data(), near.size()}, h, seed))
              kept.push_back(seed);
          }
        clamp(mesh, kept);
        seeds = to_owners(mesh, kept);
        if (scene.has_solids())
          seeds.erase(std::remove_if(seeds.begin(),
                                     seeds.end(),
                                     [&](const auto &seed) {
                                       return scene.is_in_solids(seed.position, state.time);
                                     }),
                      seeds.end());
      }

      /// Is there a surface at a seed? At thin parts and sharp edges, where some markers
      /// @p near face elsewhere, it settles on the sheet of those that face its way.
      static bool
      settles(const AroundPoint<dim> &near, const double h, Marker<dim> &seed)
      {
        constexpr double elsewhere = 0.3, its_way = 0.6; // cosines
        if (facing<dim>(near, -seed.normal, -elsewhere).empty())
          return near.size() == 0 ||
                 nearest<dim>(seed.position, near).normal * seed.normal > 0.5;
        const auto same = facing<dim>(near, seed.normal, its_way);
        if (same.empty())
          return false;
        const MarkerSheet<dim> sheet(seed.position, {same.data(), same.size()}, h);
        if (sheet.is_beside || !sheet.surrounds)
          return false;
        seed = {seed.position - sheet.distance * sheet.normal, sheet.normal};
        return true;
      }

      double
      size_at(const Point<dim> &x) const
      {
        return surface_size_of_cell(mesh, mesh.locator().locate_here(x).cell);
      }

      /// From the facets to the smooth surface they are chords of.
      void
      project(std::vector<Marker<dim>> &seeds) const
      {
        for (unsigned int round = 0; round < 2; ++round)
          {
            const auto samples = surface.level_set.samples(positions(seeds));
            for (unsigned int k = 0; k < seeds.size(); ++k)
              if (samples[k].smoothness > 0.9 && samples[k].gradient.norm() > 0)
                {
                  const Tensor<1, dim> &g = samples[k].gradient;
                  seeds[k].position -= samples[k].value * g / g.norm_square();
                  seeds[k].normal = g / g.norm();
                }
            clamp(mesh, seeds);
          }
      }

      /// At t = 0 the bodies know where their surface is. Chords of what phi shows of a small drop, or
      /// of an edge, would be those of chords one step on: a sphere of one leaf's radius would
      /// lose a fifth.
      void
      project_to_bodies(std::vector<Marker<dim>> &seeds) const
      {
        const Distance<dim> bodies  = initial_distance(scene, mesh.is_lattice(), mesh.finest_size());
        const auto          samples = surface.level_set.samples(positions(seeds));
        std::string         error; // a solid's distance may not be known
        keep_error(error, [&] {
          for (unsigned int k = 0; k < seeds.size(); ++k)
            if (samples[k].smoothness <= 0.9)
              project_to(bodies, seeds[k]);
        });
        throw_first(mesh.communicator(), error);
        clamp(mesh, seeds);
      }

      void
      project_to(const Distance<dim> &bodies, Marker<dim> &seed) const
      {
        const double      h  = size_at(seed.position);
        const Marker<dim> on = marker_on(bodies, seed.position, 1e-3 * h);
        if (on.position.distance(seed.position) < 0.5 * h)
          seed = on;
      }

      State<dim>                 &state;
      const Mesh<dim>            &mesh;
      const Scene<dim>           &scene;
      const SurfaceGeometry<dim> &surface;
      const double                per_cell; ///< markers, in the mean
      Vector                      count;    ///< of markers in each cell
      Vector                      wanted;
      std::vector<LocalIndex>     cells; ///< of the markers of this rank
    };
  } // namespace

  template <int dim>
  void
  reseed_markers(State<dim>                 &state,
                 const Scene<dim>           &scene,
                 const SurfaceGeometry<dim> &surface,
                 const unsigned int          per_cell,
                 const Guesses              &cells)
  {
    Seeding<dim>(state, scene, surface, per_cell).reseed(cells);
  }

  template void
  reseed_markers(State<2> &,
                 const Scene<2> &,
                 const SurfaceGeometry<2> &,
                 const unsigned int,
                 const Guesses &);
  template void
  reseed_markers(State<3> &,
                 const Scene<3> &,
                 const SurfaceGeometry<3> &,
                 const unsigned int,
                 const Guesses &);
} // namespace treacle
