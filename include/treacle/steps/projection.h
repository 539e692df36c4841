// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_steps_projection_h
#define treacle_steps_projection_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/steps/linear_solver.h>
#include <treacle/steps/numbering.h>

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

    /// Largest |divergence| of a pressure cell over all ranks (1/s).
    static double
    maximum_divergence(const State<dim> &state, const LiquidDomain<dim> &domain);

  private:
    /// Volume flux out of a cell (m^dim/s).
    static double
    outflow(const LiquidDomain<dim> &domain, const LocalIndex cell, const Vector &u);

    /// dt p at all dual centres: beyond the surface the liquid's pressure goes on
    /// in proportion to phi, as the ghost fluid has it across a face.
    Vector
    extended(const Vector &q) const;

    /// Take its weighted mean off dt p of each closed pocket; one weight a row.
    void
    take_off_mean(Vector &q, const std::vector<double> &weight) const;

    void
    find_closed_pockets();

    void
    assemble();

    const Parameters         prm;
    const LiquidDomain<dim> &domain;

    const Numbering                 numbering; ///< of the pressure cells
    const std::vector<LocalIndex>  &owned_cells;
    const std::vector<GlobalIndex> &number;
    const IndexSet                 &rows;
    /// Pockets without a free surface: the pressure cells of this rank in each,
    /// and how many there are on all ranks. One cell of each is pinned.
    struct Pocket
    {
      std::vector<unsigned int> rows;
      GlobalIndex               size = 0;
    };
    std::vector<Pocket>            pockets;
    std::vector<unsigned int>      pinned; ///< rows of this rank
    std::unique_ptr<TrilinosWrappers::SparseMatrix> matrix;
    std::unique_ptr<LinearSolver>                   solver;
  };
} // namespace treacle

#endif
