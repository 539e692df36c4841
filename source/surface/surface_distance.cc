// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/work.h>
#include <treacle/geometry/distance.h>
#include <treacle/geometry/nearest_point.h>
#include <treacle/mesh/near_ranks.h>
#include <treacle/surface/surface_distance.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace treacle
{
  template <int dim>
  SurfaceDistance<dim>::SurfaceDistance(const Mesh<dim>           &mesh,
                                        const Surface<dim>        &surface,
                                        const double               reach,
                                        const std::vector<double> &solid_distance)
    : reach(reach)
    , box(mesh.box())
    , tolerance(rounding_in(box))
  {
    gather_facets(mesh, surface, solid_distance);
    tree = FacetTree<dim>(facets);
  }

  namespace
  {
    /// At the centroid of a facet.
    template <int dim>
    double
    mean_over_facet(const std::vector<double> &values, const Surface<dim> &surface, const unsigned int facet)
    {
      double mean = 0;
      for (const unsigned int v : surface.facets[facet])
        {
          const auto &[a, b, t] = surface.vertices[v];
          mean += ((1 - t) * values[a] + t * values[b]) / dim;
        }
      return mean;
    }
  } // namespace

  template <int dim>
  void
  SurfaceDistance<dim>::gather_facets(const Mesh<dim>           &mesh,
                                      const Surface<dim>        &surface,
                                      const std::vector<double> &solid_distance)
  {
    const NearRanks<dim>                       near(mesh, reach);
    PerRank<std::array<double, dim * dim + 1>> to_rank(near.n_ranks());
    for (unsigned int k = 0; k < surface.facets.size(); ++k)
      {
        const Facet x = surface.facet_points(k);
        facets.push_back(x);
        in_solid.push_back(!solid_distance.empty() && mean_over_facet(solid_distance, surface, k) <= 0);
        const auto [lower, upper] =
          BoundingBox<dim>(std::vector<Point<dim>>(x.begin(), x.end())).get_boundary_points();
        near.for_each(lower, upper, [&](const unsigned int r) {
          to_rank[r].emplace_back();
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              to_rank[r].back()[dim * i + d] = x[i][d];
          to_rank[r].back().back() = in_solid.back();
        });
      }
    for (const auto &received : send_and_receive(mesh.communicator(), to_rank))
      for (const auto &numbers : received)
        {
          facets.emplace_back();
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              facets.back()[i][d] = numbers[dim * i + d];
          in_solid.push_back(numbers.back() != 0);
        }
  }

  namespace
  {
    /// An order of points that rounding does not change: by coordinates that differ by more
    /// than @p tolerance first.
    template <int dim>
    bool
    comes_first(const Point<dim> &p, const Point<dim> &q, const double tolerance)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(p[d] - q[d]) > tolerance)
          return p[d] < q[d];
      return std::lexicographical_compare(p.begin_raw(), p.end_raw(), q.begin_raw(), q.end_raw());
    }
  } // namespace

  template <int dim>
  bool
  SurfaceDistance<dim>::find_near(const Point<dim> &x, const double within) const
  {
    candidates.clear();
    double least = within;
    tree.search(x, within, [&](const unsigned int facet) {
      ++Work::here().facets_tried;
      const Point<dim> p = nearest_point(facets[facet], x);
      const double     d = p.distance(x);
      if (d < within && d <= least + tolerance)
        candidates.push_back({p, d, facet});
      least = std::min(least, d);
      return least + tolerance;
    });
    const auto is_farther = [&](const Candidate &c) { return c.distance > least + tolerance; };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_farther),
                     candidates.end());
    return least + tolerance < within;
  }

  template <int dim>
  typename SurfaceDistance<dim>::Nearest
  SurfaceDistance<dim>::nearest(const Point<dim> &x, const double expected) const
  {
    Nearest best{x, std::numeric_limits<double>::infinity()};
    // on the box a nearest point is often the corner of several facets, and in a plane of
    // symmetry two points are as near: all of them count, for their order depends on the
    // partition
    if (!(1.2 * expected < reach && find_near(x, 1.2 * expected)))
      find_near(x, reach);
    for (const Candidate &c : candidates)
      {
        if (&c == &candidates.front() || comes_first(c.point, best.point, tolerance))
          best.point = c.point;
        best.distance =
          std::min(best.distance, distance_beyond_box(x, c));
      }
    return best;
  }

  template <int dim>
  bool
  SurfaceDistance<dim>::is_any_within(const Point<dim> &x, const double distance) const
  {
    bool found = false;
    tree.search(x, distance, [&](const unsigned int facet) {
      ++Work::here().facets_tried;
      found = found || nearest_point(facets[facet], x).distance(x) <= distance;
      return found ? 0 : distance; // the search is over
    });
    return found;
  }

  namespace
  {
    /// Of length 1, or 0 for a facet which is so narrow that @p rounding (m) turns it.
    template <int dim>
    Tensor<1, dim>
    normal_of(const std::array<Point<dim>, dim> &facet, const double rounding)
    {
      constexpr double     turned  = 0.01;
      const Tensor<1, dim> a       = area_vector<dim>(facet);
      double               longest = 0;
      for (unsigned int i = 0; i < dim; ++i)
        longest = std::max(longest, facet[i].distance(facet[(i + 1) % dim]));
      const double height = dim == 2 ? longest : a.norm() / longest; // 0 / 0 is not larger either
      return turned * height > rounding ? a / a.norm() : Tensor<1, dim>();
    }

    /// Along the end of a facet on a side of the box beyond which it goes on to @p foot from its @p nearest point: of length 1, or 0 in
    /// 2D and beyond an edge of the box. Nothing for a facet that does not end there: with a corner alone on the side it may be all but along that.
    template <int dim>
    std::optional<Tensor<1, dim>>
    along_end(const std::array<Point<dim>, dim> &facet,
              const Point<dim>                  &nearest,
              const Point<dim>                  &foot,
              const BoundingBox<dim>            &box,
              const double                       tolerance)
    {
      unsigned int                  n_sides = 0;
      std::optional<Tensor<1, dim>> along;
      for (unsigned int d = 0; d < dim; ++d)
        for (const double outwards : {-1., 1.})
          {
            const double side   = outwards < 0 ? box.lower_bound(d) : box.upper_bound(d);
            const auto   beyond = [&](const Point<dim> &x) { return outwards * (x[d] - side); };
            const auto   is_on  = [&](const Point<dim> &x) { return std::abs(beyond(x)) < tolerance; };
            if (!is_on(nearest) || beyond(foot) <= tolerance)
              continue;
            ++n_sides;
            for (unsigned int i = 0; i < dim; ++i)
              if (const Point<dim> &a = facet[i], &b = facet[(i + 1) % dim]; is_on(a) && (dim == 2 || is_on(b)))
                along = dim == 2 ? Tensor<1, dim>() : (b - a) / std::max(b.distance(a), tolerance);
          }
      return along && n_sides > 1 ? Tensor<1, dim>() : along;
    }
  } // namespace

  template <int dim>
  double
  SurfaceDistance<dim>::distance_beyond_box(const Point<dim> &x, const Candidate &candidate) const
  {
    BoundingBox<dim> within = box;
    within.extend(-tolerance);
    if (within.point_inside(candidate.point, 0))
      return candidate.distance;
    const Facet         &facet  = facets[candidate.facet];
    const Tensor<1, dim> normal = normal_of<dim>(facet, tolerance);
    const double         above  = (x - candidate.point) * normal;
    const auto           along  = along_end<dim>(facet, candidate.point, x - above * normal, box, tolerance);
    if (normal == Tensor<1, dim>() || !along)
      return candidate.distance;
    constexpr double flattest = 0.5; // 30 degrees to the side
    // beyond its own end alone, not beside that
    return std::max(std::hypot(above, *along * (x - candidate.point)),
                    in_solid[candidate.facet] ? flattest * candidate.distance : 0.);
  }

  template class SurfaceDistance<2>;
  template class SurfaceDistance<3>;
} // namespace treacle
