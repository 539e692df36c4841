// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_forest_h
#define treacle_mesh_forest_h

#include <treacle/mesh/tree_order.h>

#include <deal.II/distributed/p4est_wrappers.h>

#include <functional>
#include <memory>
#include <vector>

namespace treacle
{
  /// p4est's forest of octrees while it grows from root cubes (Burstedde, Wilcox & Ghattas 2011).
  template <int dim>
  class Forest
  {
  public:
    /// With @p root_size the edge of a root cube in lattice units, a power of two. Collective.
    Forest(const MPI_Comm &comm, const TreeOrder<dim> &order, const int root_size);

    /// Of this rank, along the space filling curve.
    std::vector<Leaf<dim>>
    owned_leaves() const;

    /// What the last partition weighed them by.
    std::vector<unsigned int>
    weights() const;

    /// Leaves of other ranks that share a corner with one of this rank, along the curve. Collective.
    std::vector<Leaf<dim>>
    ghost_leaves() const;

    /// Refines those of the owned leaves, balances 2:1 over faces, edges and corners, and parts
    /// leaves evenly. Is there anything to refine on any rank? Collective.
    bool
    refine(const std::vector<bool> &is_to_refine);

    /// So that all ranks have about the same sum of the weights of owned leaves. Collective.
    void
    partition(const std::vector<unsigned int> &weight);

  private:
    using Functions    = dealii::internal::p4est::functions<dim>;
    using Types        = dealii::internal::p4est::types<dim>;
    using Connectivity = typename Types::connectivity;
    using Quadrant     = typename Types::quadrant;

    static std::unique_ptr<Connectivity, void (*)(Connectivity *)>
    connect(const TreeOrder<dim> &order);

    Leaf<dim>
    leaf_of(const unsigned int tree, const Quadrant &quadrant) const;

    /// All owned leaves along the curve: @p action takes the tree's number and the quadrant.
    void
    for_each_quadrant(const std::function<void(unsigned int, Quadrant &)> &action) const;

    /// Each owned leaf carries one, which moves along with it.
    static int &
    number(Quadrant &quadrant)
    {
      return *static_cast<int *>(quadrant.p.user_data);
    }

    void
    set_numbers(const std::function<int(unsigned int)> &of_leaf);

    static int
    number_of(typename Types::forest *, typename Types::topidx, Quadrant *quadrant)
    {
      return number(*quadrant);
    }

    /// Neighbours over faces, edges and corners.
    static constexpr auto over_corners =
      static_cast<typename Types::balance_type>(dim == 2 ? int(P4EST_CONNECT_CORNER) : int(P8EST_CONNECT_CORNER));

    const TreeOrder<dim>                                                              order;
    const int                                                                         root_size;
    const std::unique_ptr<Connectivity, void (*)(Connectivity *)>                     connectivity;
    const std::unique_ptr<typename Types::forest, void (*)(typename Types::forest *)> forest;
  };
} // namespace treacle

#endif
