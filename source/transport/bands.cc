// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/transport/bands.h>

namespace treacle
{
  template <int dim>
  void
  append(std::vector<BandPoint<dim>> &points, const std::array<Point<dim>, dim> &facet)
  {
    Tensor<1, dim> normal = area_vector<dim>(facet);
    if (const double area = normal.norm(); area > 0)
      normal /= area;
    Point<dim> centre;
    for (const Point<dim> &x : facet)
      {
        points.push_back({x, normal});
        centre += x / dim;
      }
    points.push_back({centre, normal});
  }

  template <int dim>
  BandPoints<dim>
  facets_by_level(const Surface<dim>              &surface,
                  const std::vector<Point<dim>>   &x,
                  const std::vector<unsigned int> &level)
  {
    BandPoints<dim> points;
    for (unsigned int k = 0; k < surface.facets.size(); ++k)
      {
        unsigned int largest = 0;
        for (const unsigned int i : surface.facets[k])
          largest = std::max(largest, level[i]);
        append<dim>(points[largest], surface.facet_points(k, x));
      }
    return points;
  }

  template <int dim>
  Point<dim>
  centre(const OctreeParameters<dim> &prm, const Leaf<dim> &leaf)
  {
    Point<dim> x = prm.lower_corner;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += 0.5 * prm.finest_size() * leaf.centre()[d];
    return x;
  }

  namespace
  {
    /// Do fine leaves make a difference there? Not in solids from a leaf or two on; only
    /// signs tell, for the distance of an expression need not be one.
    template <int dim>
    std::function<bool(const Point<dim> &)>
    outside_solids(const Scene<dim> &scene, const double h, const double time)
    {
      if (!scene.has_solids())
        return [](const Point<dim> &) { return true; };
      return [&scene, h, time](const Point<dim> &x) {
        bool is_open = !scene.is_in_solids(x, time);
        for (unsigned int k = 0; k < 2 * dim && !is_open; ++k)
          {
            Point<dim> aside = x;
            aside[k / 2] += k % 2 == 0 ? 2 * h : -2 * h;
            is_open = !scene.is_in_solids(aside, time);
          }
        return is_open;
      };
    }
  } // namespace

  template <int dim>
  Bands<dim>::Bands(const Octree<dim>     &octree,
                    const Scene<dim>      &scene,
                    const double           time,
                    const BandPoints<dim> &points,
                    const bool             narrow)
    : octree(octree)
    , prm(octree.parameters())
    , scene(scene)
    , time(time)
  {
    const std::vector<BandPoint<dim>> none;
    const unsigned int coarsest = prm.velocity_error == 0 ?
                                    prm.coarsest_at_surface() :
                                    std::min(prm.coarsest_at_surface(), prm.interior_level + 1);
    for (unsigned int level = coarsest; level <= prm.surface_level; ++level)
      {
        const auto of_level = points.find(level);
        bands.emplace_back(octree,
                           level,
                           of_level == points.end() ? none : of_level->second,
                           narrow ? BandWidths() : BandWidths{prm.band_width + 1., prm.air_band_width + 0.5},
                           outside_solids(scene, prm.size_of(level), time));
      }
  }

  template <int dim>
  bool
  Bands<dim>::are_in_leaves(const double most_missing) const
  {
    GlobalIndex missing = 0;
    for (const Band<dim> &band : bands)
      {
        const typename Band<dim>::Missing here = band.missing_in(octree);
        missing += here.in_all;
        if (here.at_points > 0 || missing > most_missing)
          return false;
      }
    return true;
  }

  template <int dim>
  std::vector<bool>
  Bands<dim>::touch(const std::vector<Leaf<dim>> &leaves) const
  {
    std::vector<bool> result(leaves.size(), false);
    for (const Band<dim> &band : bands)
      {
        const std::vector<bool> touched = band.touches(leaves);
        std::transform(
          result.begin(), result.end(), touched.begin(), result.begin(), std::logical_or<>());
      }
    if (!scene.emitters().empty())
      for (unsigned int i = 0; i < leaves.size(); ++i)
        result[i] = result[i] ||
                    is_within(prm,
                              leaves[i],
                              scene.distance_to_emitter_boundary(centre<dim>(prm, leaves[i]), time),
                              prm.band_width * prm.finest_size());
    return result;
  }

#define INSTANTIATE(dim)                                                                             \
  template class Bands<dim>;                                                                         \
  template void       append<dim>(std::vector<BandPoint<dim>> &, const std::array<Point<dim>, dim> &);    \
  template Point<dim> centre(const OctreeParameters<dim> &, const Leaf<dim> &);                      \
  template BandPoints<dim> facets_by_level(const Surface<dim> &,                                     \
                                           const std::vector<Point<dim>> &,                          \
                                           const std::vector<unsigned int> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
