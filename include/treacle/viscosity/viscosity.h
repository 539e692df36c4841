// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_viscosity_h
#define treacle_viscosity_viscosity_h

#include <treacle/base/choice.h>
#include <treacle/viscosity/face_fit.h>
#include <treacle/viscosity/reactions.h>

namespace treacle
{
  /// The implicit viscous step, a nodal finite volume method (Batty & Houston
  /// 2011, section 4): `(M - step D) v = M v_old` at the nodes, carried between
  /// face and node velocity by a mapping, or the same in the velocity of the faces.
  template <int dim>
  class Viscosity
  {
  public:
    enum class Mapping
    {
      face_coupled,
      face_fitted_flip,
      face_fitted_pic,
      hybrid,
      node_flip,
      node_pic
    };

    static const Choice<Mapping> mappings;

    enum class StressModel
    {
      full,
      laplacian
    };

    /// What of a cell that the surface cuts is stiff.
    enum class ElementWeighting
    {
      liquid_fraction,
      full
    };

    struct Parameters
    {
      Mapping                  mapping           = Mapping::hybrid;
      StressModel              stress_model      = StressModel::full;
      ElementWeighting         element_weighting = ElementWeighting::liquid_fraction;
      LinearSolver::Parameters solver;

      void
      add_parameters(ParameterHandler &prm);
    };

    explicit Viscosity(const Parameters &parameters)
      : prm(parameters)
    {}

    /// Changes state.u, and state.v of the active nodes. Returns the number of
    /// iterations of the implicit solve. The fit belongs to the same surface. Adds what
    /// holds the prescribed nodes to @p reactions, if there are such.
    unsigned int
    advance(State<dim>         &state,
            const FaceFit<dim> &fit,
            const double        step,
            Reactions<dim>     *reactions = nullptr) const;

    /// step mu V of each cell, in the term that the stress model has.
    typename NodeSystem<dim>::Stiffness
    stiffness(const LiquidDomain<dim> &domain, const double step) const;

  private:
    unsigned int
    advance_face_fitted(State<dim>         &state,
                        const FaceFit<dim> &fit,
                        const double        step,
                        Reactions<dim>     *reactions) const;

    unsigned int
    advance_hybrid(State<dim>         &state,
                   const FaceFit<dim> &fit,
                   const double        step,
                   Reactions<dim>     *reactions) const;

    unsigned int
    advance_nodes(State<dim>         &state,
                  const FaceFit<dim> &fit,
                  const double        step,
                  Reactions<dim>     *reactions) const;

    unsigned int
    advance_face_coupled(State<dim>         &state,
                         const FaceFit<dim> &fit,
                         const double        step,
                         Reactions<dim>     *reactions) const;

    const Parameters prm;
  };
} // namespace treacle

#endif
