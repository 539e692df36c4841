// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/maximum.h>
#include <treacle/viscosity/node_system.h>
#include <treacle/viscosity/pieces.h>

namespace treacle
{
  namespace
  {
    /// A piece turns as one if the box around it has a diagonal of at most so many times the way that momentum spreads in a step.
    constexpr double rigid_size = 14;
    /// Bodies bend and turn everywhere if momentum spreads over so much of the box, in 3D from this slenderness on: in 2D, a hierarchy with
    /// rotations costs little more.
    constexpr double stiff_part_of_box = 0.25, slender = 25;

    template <int dim>
    double
    shortest_edge(const BoundingBox<dim> &box)
    {
      double result = box.side_length(0);
      for (unsigned int d = 1; d < dim; ++d)
        result = std::min(result, box.side_length(d));
      return result;
    }
  } // namespace

  template <int dim>
  double
  NodeSystem<dim>::spread_of_momentum(const Stiffness &stiffness) const
  {
    double furthest = 0; // squared (m^2)
    for (LocalIndex c = 0; c < stiffness.strain.size(); ++c)
      if (const double mass = domain.density[c] * domain.open_volume(c); mass > 0)
        furthest = std::max(furthest, stiffness.strain[c] / mass);
    return std::sqrt(largest(domain.mesh.communicator(), furthest));
  }

  template <int dim>
  NearNullSpace
  NodeSystem<dim>::stress_free_motions(const Stiffness &stiffness) const
  {
    const double  spread = spread_of_momentum(stiffness);
    NearNullSpace space;
    space.n_components = dim;
    space.n_vectors    = dim;
    if (rigid_size * spread > domain.mesh.finest_size())
      {
        const Pieces<dim> pieces(domain, numbering);
        if (spread > stiff_part_of_box * shortest_edge(domain.mesh.box()) && (dim == 2 || pieces.slenderness() > slender))
          space.n_vectors = dim == 2 ? 3 : 6;
        space.turning = pieces.rotations(rigid_size * spread);
      }
    const std::size_t n      = dim * owned_nodes.size();
    const Point<dim>  origin = domain.mesh.middle();
    space.vectors.assign(space.n_vectors * n, 0);
    for (unsigned int i = 0; i < owned_nodes.size(); ++i)
      {
        const Tensor<1, dim> r = domain.mesh.node_position[owned_nodes[i]] - origin;
        const auto           set = [&](const unsigned int k, const unsigned int d, const double value) {
          if ((domain.constrained[owned_nodes[i]] >> d & 1) == 0)
            space.vectors[k * n + dim * i + d] = value;
        };
        for (unsigned int d = 0; d < dim; ++d)
          set(d, d, 1);
        for (unsigned int k = dim; k < space.n_vectors; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            set(k, d, turned(r, k - dim)[d]);
      }
    return space;
  }

  template NearNullSpace
  NodeSystem<2>::stress_free_motions(const Stiffness &) const;
  template NearNullSpace
  NodeSystem<3>::stress_free_motions(const Stiffness &) const;
} // namespace treacle
