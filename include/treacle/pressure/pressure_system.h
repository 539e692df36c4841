// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_pressure_pressure_system_h
#define treacle_pressure_pressure_system_h

#include <treacle/pressure/closed_pockets.h>
#include <treacle/solvers/linear_solver.h>
#include <treacle/solvers/matrix_rows.h>

namespace treacle
{
  /// Linear systems for the pressure of the pressure cells, one row a cell, with embedded
  /// solids and a ghost fluid surface (Batty, Xenos & Houston 2010): the outflow B of the cells,
  /// the forces B^T on the faces, and the projection's matrix `B M_f^-1 B^T` with its multigrid.
  /// The unknown is q = step p. One object serves all solves on one surface.
  template <int dim>
  class PressureSystem
  {
  public:
    PressureSystem(const LinearSolver::Parameters &parameters, const LiquidDomain<dim> &domain);

    PressureSystem(const PressureSystem &) = delete;

    const LiquidDomain<dim> &domain;

  private:
    const Numbering numbering; ///< of the pressure cells

  public:
    const ClosedPockets<dim> pockets;

    /// The owned pressure cells, in the order of the rows.
    const std::vector<LocalIndex> &
    cells() const
    {
      return numbering.owned;
    }

    const IndexSet &
    rows() const
    {
      return numbering.rows;
    }

    /// A vector of zeros, one a row.
    Vector
    zeros() const
    {
      return Vector(rows(), domain.mesh.communicator());
    }

    /// Write the rows of x to their cells, and update the ghosts; q is zero elsewhere.
    void
    to_cells(const Vector &x, Vector &q) const;

    /// Does the pressure act on this liquid face? Not on those of wet cells that touch no
    /// pressure cell.
    bool
    is_unknown(const LocalIndex face) const
    {
      const auto &cells = domain.mesh.face_cells[face];
      return domain.is_pressure_cell[cells[0]] || domain.is_pressure_cell[cells[1]];
    }

    /// Of q on an owned liquid face (kg m/s).
    double
    force(const LocalIndex face, const Vector &q) const
    {
      const auto &cells = domain.mesh.face_cells[face];
      return domain.open_fraction[face] * domain.mesh.face_area[face] *
             (q.local_element(cells[0]) - q.local_element(cells[1]));
    }

    /// Add what q at the cells does to the velocity of all liquid faces, those beyond the
    /// pressure cells too; updates ghosts.
    void
    push(const Vector &q, Vector &u) const;

    /// Volume flux out of a cell (m^dim/s), through solids too.
    static double
    outflow(const LiquidDomain<dim> &domain, const LocalIndex cell, const Vector &u);

    /// What flows through the cells: the norm of the sums of |flux| (m^dim/s). Collective.
    double
    throughflow(const Vector &u) const;

    /// The norm of the outflow of all cells (m^dim/s) that a correction leaves beside this velocity. Collective.
    double
    tolerated_outflow(const Vector &u) const
    {
      return solver.relative_tolerance() * throughflow(u);
    }

    /// u on the faces that solids close, and ghosts.
    void
    set_walls(Vector &u) const;

    using FaceFunction = std::function<double(const LocalIndex)>;

    /// B diag(mobility) B^T + diag(diagonal), one entry a row, with the mobility of each liquid
    /// face; that of the projection is 1 / M_f.
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    assemble(const FaceFunction &mobility, const std::vector<double> &diagonal) const
    {
      return assemble(mobility, diagonal, matrix.get());
    }

    /// Solve the projection's equation for q from what it holds. In a pocket without a free
    /// surface its mean is 0. The tolerance is relative to b, or to @p scale if that is larger.
    /// Returns the number of iterations.
    unsigned int
    solve(Vector &q, Vector &b, const double scale) const;

    const TrilinosWrappers::SparseMatrix &
    projection() const
    {
      return *matrix;
    }

    /// z = the preconditioner of the projection's matrix times r.
    void
    precondition(Vector &z, const Vector &r) const
    {
      solver.precondition(z, r);
    }

    /// Largest |divergence| of a pressure cell over all ranks (1/s).
    static double
    maximum_divergence(const State<dim> &state, const LiquidDomain<dim> &domain);

  private:
    /// With the graph of a matrix @p alike, if there is one.
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    assemble(const FaceFunction                   &mobility,
             const std::vector<double>            &diagonal,
             const TrilinosWrappers::SparseMatrix *alike) const;

    std::unique_ptr<const TrilinosWrappers::SparseMatrix>
    projection_matrix() const;

    /// The entries of the row of an owned cell.
    void
    set_row(const LocalIndex    cell,
            const FaceFunction &mobility,
            const double        diagonal,
            MatrixRow          &row) const;

    /// q at all dual centres: beyond the surface the liquid's pressure goes on
    /// in proportion to phi, as the ghost fluid has it across a face.
    Vector
    extended(const Vector &q) const;

    const std::unique_ptr<const TrilinosWrappers::SparseMatrix> matrix;
    const LinearSolver                                          solver;
  };
} // namespace treacle

#endif
