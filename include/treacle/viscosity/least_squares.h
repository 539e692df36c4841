// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_least_squares_h
#define treacle_viscosity_least_squares_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// H: node velocity from the liquid faces around a node by least squares,
  /// `(N^T N)^-1 N^T u` (the paper, section 4.3), or weighted. Nodes where singular values below
  /// 0.1 of the largest have to be cut are invalid: they receive the mean of their
  /// valid neighbours. The weights are computed once for each surface, so that H is
  /// a linear map with an exact transpose. "Unknowns" are vectors with dim entries for
  /// each of nodes().
  template <int dim>
  class LeastSquares
  {
  public:
    /// What a face counts for in the sum of squares.
    enum class Weight
    {
      one,
      mass ///< M_f; then M_f^-1 H^T spreads a smooth force smoothly over the faces
    };

    /// Collective.
    explicit LeastSquares(const LiquidDomain<dim> &domain, const Weight weight = Weight::one);

    /// v = H u at the active nodes, prescribed components set, ghosts updated.
    /// @p u must have up-to-date ghosts.
    void
    apply(const Vector &u, NodeVector<dim> &v) const;

    /// The linear part of H, from faces to unknowns: prescribed components are zero.
    /// @p u must have up-to-date ghosts.
    void
    vmult(Vector &x, const Vector &u) const;

    /// Its transpose, u = H^T x at owned faces.
    void
    Tvmult(Vector &u, const Vector &x) const;

    /// Diagonal of `H^T B H`, B made of a block for each of nodes(), without the
    /// means at invalid nodes.
    Vector
    diagonal(const std::vector<Tensor<2, dim>> &blocks) const;

    /// The active owned nodes, in order.
    const std::vector<LocalIndex> &
    nodes() const
    {
      return active_nodes;
    }

  private:
    /// Append the faces of a node and their weights. Returns whether it is valid.
    bool
    append_node(const LocalIndex node);

    void
    find_sources(const Vector &is_valid);

    /// The velocity of node i of nodes() as its own faces say.
    Tensor<1, dim>
    own_value(const unsigned int i, const Vector &u) const;

    void
    to_nodes(const Vector &x, NodeVector<dim> &v) const;

    /// Set invalid nodes to the mean of their sources.
    void
    fill(NodeVector<dim> &v) const;

    /// Its transpose: invalid nodes give what they hold to their sources.
    void
    fill_transpose(Vector &x) const;

    void
    drop_prescribed(Vector &x) const;

    double
    weight_of(const LocalIndex face) const
    {
      return weight == Weight::mass ? domain.face_mass[face] : 1;
    }

    const LiquidDomain<dim>    &domain;
    const Weight                weight;
    std::vector<LocalIndex>     active_nodes;
    std::vector<unsigned int>   start;   ///< of each active node in faces and weights
    std::vector<LocalIndex>     faces;
    std::vector<Tensor<1, dim>> weights; ///< velocity of the node per velocity of the face
    /// Invalid nodes with valid neighbours, and these as often as they share a cell.
    std::vector<LocalIndex>   filled_nodes;
    std::vector<unsigned int> source_start;
    std::vector<LocalIndex>   sources;
    bool                      any_filled = false; ///< on any rank
  };
} // namespace treacle

#endif
