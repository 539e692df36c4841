// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/maximum.h>
#include <treacle/fields/connected_liquid.h>
#include <treacle/viscosity/node_system.h>

#include <limits>

namespace treacle
{
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
  bool
  NodeSystem<dim>::turns_stiffly(const Stiffness &stiffness) const
  {
    double edge = std::numeric_limits<double>::max();
    for (unsigned int d = 0; d < dim; ++d)
      edge = std::min(edge, domain.mesh.box().side_length(d));
    const double spread = spread_of_momentum(stiffness);
    return spread > 0.25 * edge || (spread > 2 * domain.mesh.finest_size() && has_several_pieces());
  }

  template <int dim>
  bool
  NodeSystem<dim>::has_several_pieces() const
  {
    const Numbering active(domain.mesh.cells, domain.is_active_cell);
    const Vector    label = label_connected(domain, active);
    double          least = std::numeric_limits<double>::max(), most = -1;
    for (const LocalIndex c : active.owned)
      {
        least = std::min(least, label.local_element(c));
        most  = std::max(most, label.local_element(c));
      }
    const MPI_Comm &comm = domain.mesh.communicator();
    return Utilities::MPI::min(least, comm) < Utilities::MPI::max(most, comm);
  }

  template <int dim>
  NearNullSpace
  NodeSystem<dim>::stress_free_motions(const Stiffness &stiffness) const
  {
    NearNullSpace space;
    space.n_components   = dim;
    space.n_vectors       = turns_stiffly(stiffness) ? (dim == 2 ? 3 : 6) : dim;
    const std::size_t n  = dim * owned_nodes.size();
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
          {
            const unsigned int a = (k - dim) % dim, b = (k - dim + 1) % dim;
            set(k, a, -r[b]);
            set(k, b, r[a]);
          }
      }
    return space;
  }

  template NearNullSpace
  NodeSystem<2>::stress_free_motions(const Stiffness &) const;
  template NearNullSpace
  NodeSystem<3>::stress_free_motions(const Stiffness &) const;
} // namespace treacle
