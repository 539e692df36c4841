// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/surface/marker_sheet.h>

namespace treacle
{
  template <int dim>
  MarkerSheet<dim>::MarkerSheet(const Point<dim>       &x,
                                const AroundPoint<dim> &markers,
                                const double            h)
    : is_beside(true)
    , surrounds(false)
  {
    static thread_local std::vector<double> weights;
    weights.clear();
    for (const NearMarker<dim> *m : markers)
      {
        weights.push_back(weight((x - m->marker.position).norm_square(), h));
        normal += weights.back() * m->marker.normal;
      }
    if (normal.norm() == 0) // all at the very end of the reach
      return;
    normal /= normal.norm();
    // the mean distance from the planes of markers: with the mean of two normals, whose length is that along either, it is
    // exact for a sphere
    double         sum = 0;
    Tensor<1, dim> aside;
    for (unsigned int k = 0; k < markers.size(); ++k)
      {
        const Marker<dim>   &marker = markers[k]->marker;
        const Tensor<1, dim> r      = x - marker.position;
        sum += weights[k] * 0.5 * (1 + marker.normal * normal);
        distance += weights[k] * 0.5 * (r * (marker.normal + normal));
        aside += weights[k] * (r - (r * normal) * normal);
      }
    distance /= sum;
    surrounds =
      std::any_of(markers.begin(), markers.end(), [&](const NearMarker<dim> *m) {
        return (x - m->marker.position) * aside <= 0;
      });
    const Marker<dim>   &foot  = nearest<dim>(x, markers);
    const Tensor<1, dim> r     = x - foot.position;
    const double         along = std::pow(0.5 * h, 2); // more than between markers
    is_beside                  = r.norm_square() - std::pow(r * foot.normal, 2) > along;
  }

  template class MarkerSheet<2>;
  template class MarkerSheet<3>;
} // namespace treacle
