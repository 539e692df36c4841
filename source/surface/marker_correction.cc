// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/marker_correction.h>
#include <treacle/surface/marker_sheet.h>
#include <treacle/surface/smooth_level_set.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    AroundPoint<dim>
    view(const std::vector<const NearMarker<dim> *> &markers)
    {
      return AroundPoint<dim>(markers.data(), markers.size());
    }

    /// The thickness below which nodes inside a film, and in a gap, are left to phi, in
    /// leaves.
    constexpr double thinnest_film = 0.25, thinnest_gap = 0.5;

    /// phi at a node near parts so thin, or edges so sharp, that the level set says
    /// nothing there: from the sheets of markers around. @p old is what phi was.
    template <int dim>
    double
    distance_from_sheets(const Point<dim>      &x,
                         const double           old,
                         const AroundPoint<dim> same,
                         const AroundPoint<dim> opposed,
                         const double           h)
    {
      const MarkerSheet<dim> first(x, same, h);
      if (first.is_beside)
        return old;
      if (opposed.size() == 0)
        return first.distance;
      const MarkerSheet<dim> second(x, opposed, h);
      if (second.is_beside)
        return old;
      // of liquid between two sheets; negative: of air. The sum is the same on either
      // side of both, so it tells a film from a gap. Sheets that come closer than
      // markers are exact may have crossed: to trust them would let films grow. But they
      // become thinner: a thread that falls from a ceiling would pour for ever
      const double thickness = -(first.distance + second.distance);
      if (thickness <= 0)
        return thickness > -thinnest_gap * h ? old : std::min(first.distance, second.distance);
      const double of_film = std::max(first.distance, second.distance);
      return thickness < thinnest_film * h && first.distance <= 0 ? std::max(old, of_film) : of_film;
    }

    /// phi at a node from the markers around it; those on the far side of a thin part
    /// or of a corner do not count.
    template <int dim>
    double
    corrected(const Point<dim>      &x,
              const double           old,
              const AroundPoint<dim> near,
              const double           h)
    {
      const Tensor<1, dim> facing = nearest<dim>(x, near).normal;
      static thread_local std::vector<const NearMarker<dim> *> same, opposed;
      same.clear();
      opposed.clear();
      bool   is_smooth = true;
      double sum = 0, residual = 0;
      for (const NearMarker<dim> *m : near)
        {
          const double along = m->marker.normal * facing;
          if (along < -0.3)
            opposed.push_back(m);
          if (along <= 0)
            continue;
          same.push_back(m);
          const double w =
            MarkerSheet<dim>::weight((x - m->marker.position).norm_square(), h);
          is_smooth = is_smooth && !std::isnan(m->value);
          sum += w;
          residual += w * m->value;
        }
      if (sum == 0)
        return old;
      const double wanted =
        opposed.empty() && is_smooth ?
          old - residual / sum :
          distance_from_sheets<dim>(x, old, view<dim>(same), view<dim>(opposed), h);
      // a lone marker far away must not have its way with a node
      return old + std::min(sum, 1.) * (wanted - old);
    }
  } // namespace

  template <int dim>
  MarkerCorrection<dim>::MarkerCorrection(const State<dim> &state)
    : mesh(*state.mesh)
    , position(positions(state.markers))
    , markers(mesh, state.markers, MarkerSheet<dim>::reach)
    , of_node(mesh.n_owned_nodes(), {invalid, invalid})
  {}

  template <int dim>
  typename MarkerCorrection<dim>::Near
  MarkerCorrection<dim>::around(const LocalIndex node, const double size)
  {
    auto &[begin, end] = of_node[node];
    if (begin == invalid)
      {
        begin = near.size();
        markers.append_around(mesh.node_position[node], size, near);
        end = near.size();
      }
    return Near(near.data() + begin, end - begin);
  }

  template <int dim>
  void
  MarkerCorrection<dim>::apply(State<dim> &state)
  {
    std::vector<double> values;
    for (const auto &at : SmoothLevelSet<dim>(mesh, state.phi).samples(position, guesses))
      values.push_back(at.smoothness < 0.5 ? std::nan("") : at.value);
    markers.set_values(values);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double &phi = state.phi.local_element(node);
        if (std::abs(phi) > 3 * mesh.surface_size())
          continue;
        const double h = surface_size_at_node(mesh, node);
        if (std::abs(phi) > 3 * h)
          continue;
        if (const Near near = around(node, h); near.size() > 0)
          phi = corrected<dim>(mesh.node_position[node], phi, near, h);
      }
    state.phi.update_ghost_values();
  }

  template class MarkerCorrection<2>;
  template class MarkerCorrection<3>;
} // namespace treacle
