// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_full_container_h
#define treacle_fields_full_container_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// What closed parts of faces carry into some cells (m^dim/s).
  struct Inflow
  {
    double net         = 0; ///< of solids that make room, too
    double at_emitters = 0; ///< into and out of cells at emitters, added up

    /// Is there no room for most of what emitters pour? Not from one that stirs.
    bool
    is_too_much() const
    {
      return at_emitters > 0 && net > 0.5 * at_emitters;
    }
  };

  /// Into cells of this rank, over all ranks. Collective.
  template <int dim>
  Inflow
  inflow_into(const LiquidDomain<dim> &domain, const std::vector<LocalIndex> &cells);

  /// Does liquid flow through a face of the pressure cell that has air behind it?
  template <int dim>
  bool
  has_free_surface(const LiquidDomain<dim> &domain, const LocalIndex cell);

  /// For what emitters pour (m^dim); none where they rest.
  struct Room
  {
    double air   = 0; ///< outside of solids, less what liquid that is missing takes
    double layer = 0; ///< what emitters fill while their liquid crosses a leaf; known where there is little air
  };

  /// Where so much liquid (m^dim) is @p missing that volume correction is to bring back. Collective.
  template <int dim>
  Room
  room(const LiquidDomain<dim> &domain, const double missing = 0);

  /// Has no liquid a free surface, or less air than a layer, while emitters pour? Collective.
  template <int dim>
  bool
  is_full(const LiquidDomain<dim> &domain);

  /// Of a state. Where it is full emitters rest. @p data must outlive it. Throws like its constructor. Collective.
  template <int dim>
  std::shared_ptr<const LiquidDomain<dim>>
  liquid_domain_of(const typename LiquidDomain<dim>::Parameters &parameters, const State<dim> &state, const MeshData<dim> &data);
} // namespace treacle

#endif
