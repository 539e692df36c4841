// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_smooth_level_set_h
#define treacle_surface_smooth_level_set_h

#include <treacle/mesh/tracer.h>

namespace treacle
{
  /// phi between the nodes, with nodal gradients: as exact as a quadratic function across its gradient, linear
  /// along it (see NodeField). Refers to the mesh and phi. Members that return values at points are collective.
  template <int dim>
  class SmoothLevelSet
  {
  public:
    SmoothLevelSet(const Mesh<dim> &mesh, const Vector &phi);

    /// At the nodes.
    const NodeVector<dim> &
    gradients() const
    {
      return gradient;
    }

    std::vector<double>
    values(const std::vector<Point<dim>> &x, Guesses &guesses) const;

    struct Sample
    {
      double         value;
      Tensor<1, dim> gradient;
      double         smoothness; ///< 1: a distance all around; 0: at kinks, in thin parts
    };

    std::vector<Sample>
    samples(const std::vector<Point<dim>> &x, Guesses &guesses) const;

    std::vector<Sample>
    samples(const std::vector<Point<dim>> &x) const
    {
      Guesses none;
      return samples(x, none);
    }

  private:
    const Mesh<dim> &mesh;
    const Vector    &phi;
    NodeVector<dim>  gradient;
    Vector           smoothness;
  };
} // namespace treacle

#endif
