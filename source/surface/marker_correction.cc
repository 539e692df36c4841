// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/marker_correction.h>
#include <treacle/surface/smooth_level_set.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    using Near = ArrayView<const NearMarker<dim> *const>;

    template <int dim>
    Near<dim>
    view(const std::vector<const NearMarker<dim> *> &markers)
    {
      return Near<dim>(markers.data(), markers.size());
    }

    /// How far a marker is felt, and the thickness below which films are left to phi, in
    /// leaves.
    constexpr double reach = 1.25, thinnest = 0.5;

    /// Wendland's function, whose Fourier transform is positive. With others the mean over
    /// markers turns the sign of waves as short as the leaves, and what is taken off makes
    /// them grow, step by step.
    double
    weight(const double squared_distance, const double h)
    {
      const double r      = std::sqrt(squared_distance) / (reach * h);
      const double square = (1 - r) * (1 - r);
      return square * square * (4 * r + 1);
    }

    /// A sheet of markers that face one way, as seen from a node.
    struct Sheet
    {
      double distance;  ///< signed (m)
      bool   is_beside; ///< the node lies beyond the sheet's end
    };

    /// The mean distance from the planes of markers. With the mean of two normals it is
    /// exact for a sphere.
    template <int dim>
    Sheet
    sheet(const Point<dim> &x, const Near<dim> markers, const double h)
    {
      double         sum = 0, distance = 0;
      Tensor<1, dim> mean;
      for (const NearMarker<dim> *m : markers)
        mean += weight((x - m->marker.position).norm_square(), h) * m->marker.normal;
      if (mean.norm() == 0) // all at the very end of the reach
        return {0, true};
      mean /= mean.norm();
      for (const NearMarker<dim> *m : markers)
        {
          const Tensor<1, dim> r = x - m->marker.position;
          const double         w = weight(r.norm_square(), h);
          sum += w;
          distance += w * 0.5 * (r * (m->marker.normal + mean));
        }
      const Marker<dim>   &foot  = nearest<dim>(x, markers);
      const Tensor<1, dim> r     = x - foot.position;
      const double         along = std::pow(0.4 * reach * h, 2); // more than between markers
      return {distance / sum, r.norm_square() - std::pow(r * foot.normal, 2) > along};
    }

    /// phi at a node near parts so thin, or edges so sharp, that the level set says
    /// nothing there: from the sheets of markers around. @p old is what phi was.
    template <int dim>
    double
    distance_from_sheets(const Point<dim> &x,
                         const double      old,
                         const Near<dim>   same,
                         const Near<dim>   opposed,
                         const double      h)
    {
      const Sheet first = sheet<dim>(x, same, h);
      if (first.is_beside)
        return old;
      if (opposed.size() == 0)
        return first.distance;
      const Sheet second = sheet<dim>(x, opposed, h);
      if (second.is_beside)
        return first.distance;
      // of liquid between two sheets; negative: of air. The sum is the same on either
      // side of both, so it tells a film from a gap. Sheets that come closer than
      // markers are exact may have crossed: to trust them would let films grow
      const double thickness = -(first.distance + second.distance);
      if (std::abs(thickness) < thinnest * h)
        return old;
      return thickness > 0 ? std::max(first.distance, second.distance) :
                             std::min(first.distance, second.distance);
    }

    /// phi at a node from the markers around it; those on the far side of a thin part
    /// or of a corner do not count.
    template <int dim>
    double
    corrected(const Point<dim> &x, const double old, const Near<dim> near, const double h)
    {
      const Tensor<1, dim> facing = nearest<dim>(x, near).normal;
      static thread_local std::vector<const NearMarker<dim> *> same, opposed;
      same.clear();
      opposed.clear();
      bool                 is_smooth = true;
      double               sum = 0, residual = 0;
      for (const NearMarker<dim> *m : near)
        {
          const double along = m->marker.normal * facing;
          if (along < -0.3)
            opposed.push_back(m);
          if (along <= 0)
            continue;
          same.push_back(m);
          const double w = weight((x - m->marker.position).norm_square(), h);
          is_smooth      = is_smooth && !std::isnan(m->value);
          sum += w;
          residual += w * m->value;
        }
      if (sum == 0)
        return old;
      const double wanted = opposed.empty() && is_smooth ?
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
    , markers(mesh, state.markers, reach)
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
