// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_pressure_projection_h
#define treacle_pressure_projection_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/fields/numbering.h>
#include <treacle/solvers/linear_solver.h>

namespace treacle
{
  /// Pressure projection with embedded solids and a ghost fluid surface (Batty,
  /// Xenos & Houston 2010): the face velocity of least kinetic energy
  /// `1/2 |u - u*|^2 in M_f` whose divergence vanishes in every pressure cell.
  /// One object serves all projections on one surface.
  template <int dim>
  class Projection
  {
  public:
    struct Parameters
    {
      double                   minimum_theta = 1e-4;
      LinearSolver::Parameters solver{"amg", 1e-8, 1000};

      void
      add_parameters(ParameterHandler &prm);
    };

    Projection(const Parameters &parameters, const LiquidDomain<dim> &domain);

    Projection(const Projection &) = delete;

    /// Is a projection the first of its step, or does it correct an earlier one?
    enum class Pass
    {
      first,
      correction
    };

    /// Make state.u free of divergence; sets state.pressure, or adds to it in a
    /// correction. In a pocket without a free surface the mean of the pressure is 0.
    /// Returns the number of iterations.
    unsigned int
    advance(State<dim> &state, const double dt, const Pass pass) const;

    // -- the discrete operators, for a solve that couples pressure with viscosity --

    /// The owned pressure cells, in the order of the rows.
    const std::vector<LocalIndex> &
    cells() const
    {
      return owned_cells;
    }

    const IndexSet &
    pressure_rows() const
    {
      return rows;
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

    /// Of q = dt p on an owned liquid face (kg m/s).
    double
    force(const LocalIndex face, const Vector &q) const
    {
      const auto &cells = domain.mesh.face_cells[face];
      return domain.open_fraction[face] * domain.mesh.face_area[face] *
             (q.local_element(cells[0]) - q.local_element(cells[1]));
    }

    /// What q = dt p adds to the velocity of an owned liquid face (m/s).
    double
    impulse(const LocalIndex face, const Vector &q, const Vector &q_beyond) const
    {
      return is_unknown(face) ? force(face, q) / domain.face_mass[face] :
                                domain.theta[face] * force(face, q_beyond) / domain.face_mass[face];
    }

    /// q at all dual centres: beyond the surface the liquid's pressure goes on
    /// in proportion to phi, as the ghost fluid has it across a face.
    Vector
    extended(const Vector &q) const;

    /// Volume flux out of a cell (m^dim/s), through solids too.
    static double
    outflow(const LiquidDomain<dim> &domain, const LocalIndex cell, const Vector &u);

    /// The same through liquid faces alone.
    double
    linear_outflow(const LocalIndex cell, const Vector &u) const;

    /// u on the faces that solids close, and ghosts.
    void
    set_walls(Vector &u) const;

    /// Take its mean off the right-hand side of each closed pocket.
    void
    balance(Vector &b) const;

    /// Take the mean of dt p off in each closed pocket.
    void
    take_off_mean(Vector &q) const;

    using FaceFunction = std::function<double(const LocalIndex)>;

    /// B diag(mobility) B^T + diag(diagonal), one entry a row, with the mobility of each liquid
    /// face; that of the projection is 1 / M_f.
    std::unique_ptr<TrilinosWrappers::SparseMatrix>
    assemble(const FaceFunction &mobility, const std::vector<double> &diagonal) const;

    /// z = the preconditioner of the pressure's matrix times r.
    void
    precondition(Vector &z, const Vector &r) const
    {
      solver->precondition(z, r);
    }

    /// Largest |divergence| of a pressure cell over all ranks (1/s).
    static double
    maximum_divergence(const State<dim> &state, const LiquidDomain<dim> &domain);

  private:
    /// Pockets without a free surface: the pressure cells of this rank in each,
    /// and how many there are on all ranks. One cell of each is pinned.
    struct Pocket
    {
      std::vector<unsigned int> rows;
      GlobalIndex               size = 0;
    };

    /// Take its weighted mean off dt p of each closed pocket; one weight a row.
    void
    take_off_mean(Vector &q, const std::vector<double> &weight) const;

    void
    find_closed_pockets();

    /// Throws a UserError where an emitter pours into a full container.
    void
    check_room(const Pocket &pocket) const;

    void
    set_up_solver();

    const Parameters         prm;
    const LiquidDomain<dim> &domain;

    const Numbering                 numbering; ///< of the pressure cells
    const std::vector<LocalIndex>  &owned_cells;
    const std::vector<GlobalIndex> &number;
    const IndexSet                 &rows;
    std::vector<Pocket>             pockets;
    std::vector<unsigned int>       pinned; ///< rows of this rank
    std::unique_ptr<TrilinosWrappers::SparseMatrix> matrix;
    std::unique_ptr<LinearSolver>                   solver;
  };
} // namespace treacle

#endif
