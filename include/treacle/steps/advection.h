// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_steps_advection_h
#define treacle_steps_advection_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/steps/smooth_level_set.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// Semi-Lagrangian advection from the old state into a new or the same mesh, of the
  /// velocity also after MacCormack (Selle et al. 2008): what is lost on the way back and
  /// forth is added to it, within the bounds of the cell that it is read from.
  template <int dim>
  class Advection
  {
  public:
    struct Parameters
    {
      std::string scheme = "semi-Lagrangian";

      /// Subsection Advection.
      void
      add_parameters(ParameterHandler &prm);
    };

    Advection(const Parameters        &parameters,
              const State<dim>        &old,
              const LiquidDomain<dim> &domain);

    /// The state at old.time + dt: phi, carried material, and u within @p reach (m)
    /// of the liquid.
    State<dim>
    advance(std::shared_ptr<const Mesh<dim>> mesh, const double dt, const double reach) const;

    /// Where points of the surface are after dt.
    std::vector<Point<dim>>
    move_surface(const std::vector<Point<dim>> &x, const double dt) const;

    /// The markers after dt, still on the ranks they came from.
    std::vector<Marker<dim>>
    move_markers(const double dt) const;

    /// phi at points of the new time.
    std::vector<double>
    level_set(const std::vector<Point<dim>> &x, const double dt) const;

  private:
    /// Values of old node fields, by the scheme, at points from which @p velocity
    /// carries them on: [point * fields + field].
    std::vector<double>
    carried(const std::vector<const Vector *> &fields,
            const NodeVector<dim>             &velocity,
            const std::vector<Point<dim>>     &from,
            const double                       dt,
            const double                       reach) const;

    void
    advance_nodes(State<dim> &state, const double dt, const double reach) const;

    void
    advance_faces(State<dim> &state, const double dt, const double reach) const;

    const Parameters  prm;
    const State<dim> &old;
    /// What moves the surface: the node velocity, but at walls and in solids that
    /// of the nodes beside them. With the wall's own velocity a film of air
    /// would remain under all that falls on it, for a P1 velocity vanishes there.
    NodeVector<dim>     surface_velocity;
    SmoothLevelSet<dim> phi;
  };
} // namespace treacle

#endif
