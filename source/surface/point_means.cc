// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/surface/point_means.h>

namespace treacle
{
  namespace
  {
    /// Of the jump: as far from the mean over its points may a node be. That has the noise of where they lie, and keeps the shape of what is brought.
    constexpr double most_apart = 0.1;

    double
    log_of(const double value)
    {
      return std::log(std::max(value, 1e-300));
    }

    /// Of the mean of logarithms and of their squares. The variance of two values is the product; that of
    /// values that are spread evenly between them is a third of it.
    bool
    has_two_values(const double least, const double largest, const double mean, const double squares)
    {
      return squares - mean * mean > 0.6 * (mean - log_of(least)) * (log_of(largest) - mean);
    }
  } // namespace

  template <int dim>
  PointMeans<dim>::PointMeans(const MeshData<dim>                   &data,
                              const std::vector<MaterialPoint<dim>> &points,
                              const std::vector<Location<dim>>      &place)
    : data(data)
    , mesh(data.mesh)
    , points(points)
    , place(place)
    , weights(mesh.nodes)
  {
    for_each([&](const LocalIndex node, const double w, unsigned int) { weights.local_element(node) += w; });
    weights.compress(VectorOperation::add);
  }

  template <int dim>
  void
  PointMeans<dim>::give(const MaterialProperty<dim> &property, const Vector &known) const
  {
    CarriedField &field = property.field;
    Vector        brought = field.mean;
    brought.update_ghost_values();
    find_jumps(property);
    smooth(field, known);
    const Vector missing = missed(property, brought);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (const double jump = field.largest.local_element(node) - field.least.local_element(node); jump > 0 && weight(node) > 0)
        {
          double      &mean   = field.mean.local_element(node);
          const double wanted = brought.local_element(node) + missing.local_element(node);
          mean                = std::min(std::max(wanted, mean - most_apart * jump), mean + most_apart * jump);
        }
    field.update_ghost_values();
  }

  template <int dim>
  void
  PointMeans<dim>::find_jumps(const MaterialProperty<dim> &property) const
  {
    CarriedField &field = property.field;
    Vector        sum(mesh.nodes), logarithms(mesh.nodes), squares(mesh.nodes);
    fill(field.least, std::numeric_limits<double>::max());
    fill(field.largest, -std::numeric_limits<double>::max());
    for_each([&](const LocalIndex node, const double w, const unsigned int k) {
      const double value = points[k].*property.of_point, logarithm = log_of(value);
      double      &least = field.least.local_element(node), &largest = field.largest.local_element(node);
      sum.local_element(node) += w * value;
      logarithms.local_element(node) += w * logarithm;
      squares.local_element(node) += w * logarithm * logarithm;
      least   = std::min(least, value);
      largest = std::max(largest, value);
    });
    for (Vector *v : {&sum, &logarithms, &squares})
      v->compress(VectorOperation::add);
    field.least.compress(VectorOperation::min);
    field.largest.compress(VectorOperation::max);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        double &mean = field.mean.local_element(node);
        double &least = field.least.local_element(node), &largest = field.largest.local_element(node);
        const auto part = [&](const Vector &v) { return v.local_element(node) / weight(node); };
        if (weight(node) > 0 && property.jumps(least, largest) &&
            has_two_values(least, largest, part(logarithms), part(squares)))
          {
            mean = std::min(std::max(part(sum), least), largest);
            continue;
          }
        // points on one side of a node do not see all that is about
        if (weight(node) > 0)
          mean = std::min(std::max({mean, 1.5 * least - 0.5 * largest, 0.5 * least}), 1.5 * largest - 0.5 * least);
        least = largest = mean;
      }
    field.update_ghost_values();
  }

  template <int dim>
  void
  PointMeans<dim>::smooth(CarriedField &field, const Vector &known) const
  {
    const CarriedField before = field;
    before.update_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        TwoValues two;
        for (const auto &neighbour : data.neighbours(node))
          two.add(before.least.local_element(neighbour.node), before.largest.local_element(neighbour.node));
        if (!two.exist())
          continue;
        field.least.local_element(node)   = two.least();
        field.largest.local_element(node) = two.largest();
        mean_of_neighbours(
          data,
          node,
          [&](const LocalIndex other) { return known.local_element(other) > 0; },
          [&](const LocalIndex other) { return before.mean.local_element(other); },
          field.mean.local_element(node));
      }
  }

  template <int dim>
  Vector
  PointMeans<dim>::missed(const MaterialProperty<dim> &property, const Vector &brought) const
  {
    std::vector<double> of_point(points.size());
    for (unsigned int k = 0; k < points.size(); ++k)
      of_point[k] =
        points[k].*property.mean_of_point - interpolate(mesh.values(place[k].cell, brought), place[k].lambda);
    Vector result(mesh.nodes);
    for_each([&](const LocalIndex node, const double w, const unsigned int k) {
      result.local_element(node) += w * of_point[k];
    });
    result.compress(VectorOperation::add);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (weight(node) > 0)
        result.local_element(node) /= weight(node);
    return result;
  }

  template class PointMeans<2>;
  template class PointMeans<3>;
} // namespace treacle
