// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/surface/marker_distance.h>

namespace treacle
{
  namespace
  {
    /// The thickness below which nodes inside a film, and in a gap, are left to phi, in
    /// leaves.
    constexpr double thinnest_film = 0.25, thinnest_gap = 0.5;

    /// The sheets of markers around a point near parts so thin, or edges so sharp, that the level set says nothing there.
    template <int dim>
    struct Sheets
    {
      MarkerSheet<dim>                first;
      std::optional<MarkerSheet<dim>> second; ///< that faces it

      Sheets(const Point<dim> &x, const AroundPoint<dim> same, const AroundPoint<dim> opposed, const double h)
        : first(x, same, h)
      {
        if (!first.is_beside && opposed.size() > 0)
          second.emplace(x, opposed, h);
      }

      bool
      is_beside() const
      {
        return first.is_beside || (second && second->is_beside);
      }

      /// Of liquid between two sheets; negative: of air. The sum is the same on either
      /// side of both, so it tells a film from a gap.
      double
      thickness() const
      {
        return -(first.distance + second->distance);
      }

      /// phi, where it was @p old; none where that is better.
      std::optional<double>
      distance(const double old, const double h) const
      {
        if (is_beside())
          return {};
        if (!second)
          return first.distance;
        // Sheets that come closer than markers are exact may have crossed: to trust them would let films grow. But they
        // become thinner: a thread that falls from a ceiling would pour for ever
        if (thickness() <= 0)
          return thickness() > -thinnest_gap * h ? std::nullopt :
                                                   std::make_optional(std::min(first.distance, second->distance));
        const double of_film = std::max(first.distance, second->distance);
        return thickness() < thinnest_film * h && first.distance <= 0 && of_film < old ? std::nullopt :
                                                                                        std::make_optional(of_film);
      }
    };

    /// The markers around a point of one side of a thin part or corner, and of the other.
    template <int dim>
    struct Sides
    {
      static constexpr double beside = 0.05; ///< cosine; faces at right angles are not to count by roundoff

      std::vector<const NearMarker<dim> *> same, opposed;
      bool                                 is_smooth; ///< has phi a value at all of the same side
      double                               sum, residual; ///< of weights, and by these of phi

      void
      find(const Point<dim> &x, const AroundPoint<dim> near, const Tensor<1, dim> &facing, const double h)
      {
        same.clear();
        opposed.clear();
        is_smooth = true;
        sum = residual = 0;
        for (const NearMarker<dim> *m : near)
          {
            const double along = m->marker.normal * facing;
            if (along < ThinPart::facing_away)
              opposed.push_back(m);
            if (along <= beside)
              continue;
            same.push_back(m);
            const double w = MarkerSheet<dim>::weight((x - m->marker.position).norm_square(), h);
            is_smooth      = is_smooth && !std::isnan(m->value);
            sum += w;
            residual += w * m->value;
          }
      }

      /// A lone marker far away must not have its way with a node.
      double
      part_corrected() const
      {
        return std::min(sum, 1.);
      }
    };
  } // namespace

  template <int dim>
  std::optional<double>
  corrected(const Point<dim>      &x,
            const double           old,
            const AroundPoint<dim> near,
            const Marker<dim>     &nearest,
            const double           h,
            const bool             phi_is_known)
  {
    static thread_local Sides<dim> sides;
    sides.find(x, near, nearest.normal, h);
    if (sides.sum == 0)
      return {};
    const std::optional<double> wanted =
      phi_is_known && sides.opposed.empty() && sides.is_smooth ?
        old - sides.residual / sides.sum :
        Sheets<dim>(x, view<dim>(sides.same), view<dim>(sides.opposed), h).distance(old, h);
    return wanted ? std::make_optional(old + sides.part_corrected() * (*wanted - old)) : std::nullopt;
  }

  template <int dim>
  std::optional<double>
  corrected_in_film(const Point<dim>      &x,
                    const double           old,
                    const AroundPoint<dim> near,
                    const Marker<dim>     &nearest,
                    const double           h)
  {
    static thread_local Sides<dim> sides;
    sides.find(x, near, nearest.normal, h);
    if (sides.sum == 0 || sides.opposed.empty())
      return {};
    const Sheets<dim> sheets(x, view<dim>(sides.same), view<dim>(sides.opposed), h);
    if (sheets.is_beside() || sheets.thickness() <= 0)
      return {};
    return old + sides.part_corrected() * (sheets.distance(old, h).value_or(old) - old);
  }

  template <int dim>
  double
  part_corrected(const Point<dim> &x, const AroundPoint<dim> near, const Marker<dim> &nearest, const double h)
  {
    static thread_local Sides<dim> sides;
    sides.find(x, near, nearest.normal, h);
    return sides.part_corrected();
  }

  template std::optional<double>
  corrected(const Point<2> &, const double, const AroundPoint<2>, const Marker<2> &, const double, const bool);
  template std::optional<double>
  corrected_in_film(const Point<2> &, const double, const AroundPoint<2>, const Marker<2> &, const double);
  template double
  part_corrected(const Point<2> &, const AroundPoint<2>, const Marker<2> &, const double);
  template std::optional<double>
  corrected(const Point<3> &, const double, const AroundPoint<3>, const Marker<3> &, const double, const bool);
  template std::optional<double>
  corrected_in_film(const Point<3> &, const double, const AroundPoint<3>, const Marker<3> &, const double);
  template double
  part_corrected(const Point<3> &, const AroundPoint<3>, const Marker<3> &, const double);
} // namespace treacle
