// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_node_system_h
#define treacle_viscosity_node_system_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/numbering.h>
#include <treacle/solvers/linear_solver.h>
#include <treacle/solvers/matrix_rows.h>
#include <treacle/viscosity/kinks.h>
#include <treacle/viscosity/skin.h>

namespace treacle
{
  /// Linear systems for the velocity at the active nodes, dim rows a node.
  /// Prescribed components are eliminated symmetrically: their rows hold the
  /// diagonal alone. Each rank assembles the rows of its own nodes, for it
  /// knows all the cells around them.
  template <int dim>
  class NodeSystem
  {
  public:
    explicit NodeSystem(const LiquidDomain<dim> &domain);

    NodeSystem(const NodeSystem &) = delete;

    /// Which mass a matrix holds: none, the lumped one of the nodes (M), or that of
    /// the faces seen from the nodes (P^T M_f P).
    enum class Mass
    {
      none,
      nodes,
      faces
    };

    /// At each owned node, or none: the force `pull - strength v`, times a time.
    struct Springs
    {
      std::vector<SymmetricTensor<2, dim>> strength; ///< kg
      std::vector<Tensor<1, dim>>          pull;     ///< kg m/s
    };

    /// Weights of the two terms in each cell; an empty one is zero. In a cell that a
    /// solid cuts they are for its open part, whose strain takes the wall into account. For -step D they
    /// are step mu V: of the strain for the full stress, of the gradient for
    /// div(mu grad v).
    struct Stiffness
    {
      std::vector<double> strain;   ///< of 2 e:e'
      std::vector<double> gradient; ///< of grad v : grad v'
      Springs             springs{};
      Skin<dim>           skin{}; ///< in the term with strain
      Kinks<dim>          kinks{}; ///< besides the term with strain

      /// Of both terms.
      double
      in_cell(const LocalIndex c) const
      {
        return (strain.empty() ? 0 : strain[c]) + (gradient.empty() ? 0 : gradient[c]);
      }
    };

    struct Assembled
    {
      std::shared_ptr<TrilinosWrappers::SparseMatrix> matrix;
      /// What prescribed values and springs contribute to the right-hand side.
      Vector shift;
    };

    /// The sum of a mass and a stiffness. Without strain and P^T M_f P the
    /// components are decoupled, and so are they in the matrix.
    Assembled
    assemble(const Mass mass, const Stiffness &stiffness) const
    {
      return assemble(mass, stiffness, domain.face_mass);
    }

    /// With another weight of each face in the place of M_f.
    Assembled
    assemble(const Mass                 mass,
             const Stiffness           &stiffness,
             const std::vector<double> &face_mass) const;

    /// The unknowns of v, prescribed components set.
    Vector
    unknowns(const NodeVector<dim> &v) const;

    /// Write x to the active nodes of v and update its ghosts.
    void
    to_nodes(const Vector &x, NodeVector<dim> &v) const;

    /// Right-hand side from the mass times velocity of free components, and the
    /// shift; prescribed components receive diagonal times value.
    Vector
    right_hand_side(const std::vector<Tensor<1, dim>> &momentum, const Assembled &assembled) const;

    /// P^T M_f u at owned nodes (kg m/s).
    std::vector<Tensor<1, dim>>
    face_momentum(const Vector &u) const
    {
      return face_momentum(u, domain.face_mass);
    }

    std::vector<Tensor<1, dim>>
    face_momentum(const Vector &u, const std::vector<double> &face_mass) const;

    /// Active and owned, in the order of the rows.
    const std::vector<LocalIndex> &
    nodes() const
    {
      return owned_nodes;
    }

    /// Motions without stress, zero at prescribed components: translations, and the rotations of pieces that are so stiff that
    /// each turns as one; where one is slender and stiff, rotations of all liquid about one centre. Collective.
    NearNullSpace
    stress_free_motions(const Stiffness &stiffness) const;

    const LiquidDomain<dim> &domain;

  private:
    /// How far viscosity spreads momentum in a step, sqrt(nu dt) at its largest (m). Collective.
    double
    spread_of_momentum(const Stiffness &stiffness) const;

    /// The rows of a node: blocks of dim by dim.
    struct Row;

    void
    add_stiffness(const Stiffness &stiffness,
                  const LocalIndex node,
                  const LocalIndex cell,
                  Row             &row) const;

    /// Of the faces whose lower cell this is.
    void
    add_face_mass(const std::vector<double> &face_mass,
                  const LocalIndex           node,
                  const LocalIndex           cell,
                  Row                       &row) const;

    void
    assemble_row(const Mass                 mass,
                 const Stiffness           &stiffness,
                 const std::vector<double> &face_mass,
                 const LocalIndex           node,
                 Row                       &row) const;

    /// The rows of owned node i of nodes() into the matrix, sorted, and the shift.
    void
    insert(Row                &row,
           const unsigned int  i,
           const bool          decoupled,
           Vector             &shift,
           MatrixRows         &matrix) const;

    const Numbering                 numbering; ///< of the active nodes
    const std::vector<LocalIndex>  &owned_nodes;
    const std::vector<GlobalIndex> &number;
    const IndexSet                 &rows;
    /// The first matrix with Mass::faces: all of them have one graph.
    mutable std::shared_ptr<const TrilinosWrappers::SparseMatrix> with_faces;
  };
} // namespace treacle

#endif
