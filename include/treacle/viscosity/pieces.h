// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_pieces_h
#define treacle_viscosity_pieces_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/numbering.h>
#include <treacle/solvers/balancing.h>

namespace treacle
{
  /// Velocity at r from its centre (m/s) of what turns about an axis, in 3D one of three, at 1 rad/s.
  template <int dim>
  Tensor<1, dim>
  turned(const Tensor<1, dim> &r, const unsigned int axis)
  {
    const unsigned int a = axis, b = (axis + 1) % dim;
    Tensor<1, dim>     result;
    result[a] = -r[b];
    result[b] = r[a];
    return result;
  }

  /// Pieces of liquid: sets of active nodes that no active cell connects, so that no matrix of nodes couples them.
  template <int dim>
  class Pieces
  {
  public:
    /// @p numbering of the active nodes. Both must outlive this object. Collective.
    Pieces(const LiquidDomain<dim> &domain, const Numbering &numbering);

    /// Of the piece that has most: the diagonal of the box around it, times the area of its free surface over its volume, both of active cells.
    /// In 3D about 13 for a cube on a floor, 24 for a square column four and a half times as high as wide. Collective.
    double
    slenderness() const;

    /// Of each piece in a box whose diagonal is at most @p largest (m), about the centre of the nodes that are held in all
    /// components, or of all its nodes where there are none; zero at prescribed components. Rows are the components of
    /// numbered nodes, one after the other.
    PartMotions
    rotations(const double largest) const;

  private:
    /// On all ranks together.
    unsigned int
    n() const
    {
      return sums.size() / n_sums;
    }

    void
    add(const unsigned int p, const Point<dim> &x, const bool is_held);

    Point<dim>
    centre(const unsigned int p) const;

    /// Diagonal of the box around it (m).
    double
    size(const unsigned int p) const;

    const LiquidDomain<dim>       &domain;
    const std::vector<LocalIndex> &nodes;
    std::vector<unsigned int>      piece; ///< of each active node, owned or ghost

    static constexpr unsigned int n_sums = 2 * (dim + 1);
    std::vector<double>           sums;   ///< of positions, and the number of nodes; of all, of those that are held
    std::vector<double>           bounds; ///< from above and, negative, from below, for each axis
  };
} // namespace treacle

#endif
