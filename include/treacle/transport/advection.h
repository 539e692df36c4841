// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_advection_h
#define treacle_transport_advection_h

#include <treacle/fields/backward_difference.h>
#include <treacle/fields/liquid_domain.h>
#include <treacle/mesh/tracer.h>
#include <treacle/surface/marker_motion.h>
#include <treacle/surface/surface_geometry.h>
#include <treacle/transport/carried_fields.h>
#include <treacle/transport/velocity_in_time.h>

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
    enum class Scheme
    {
      semi_lagrangian,
      maccormack
    };

    struct Parameters
    {
      Scheme scheme = Scheme::semi_lagrangian;

      /// Subsection Advection.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// By the step of a backward difference, with a velocity that keeps the liquid's volume or not. All must
    /// outlive this object.
    Advection(const Parameters           &parameters,
              const State<dim>           &old,
              const LiquidDomain<dim>    &domain,
              const SurfaceGeometry<dim> &surface,
              const BackwardDifference   &difference,
              const bool                  keeps_volume = true);

    /// Does the surface go with the liquid, or stay?
    enum class SurfaceMotion
    {
      carried,
      none
    };

    /// What the next state knows of the old velocity.
    enum class Memory
    {
      none,
      velocity
    };

    /// The state at old.time + dt: phi, carried material, u of the faces that may carry
    /// liquid, which is what the backward difference starts from, and what it remembers for the next one. MacCormack's correction
    /// needs what is within @p reach (m) of the liquid. A surface that stays needs the old mesh.
    State<dim>
    advance(std::shared_ptr<const Mesh<dim>> mesh,
            const double                     reach,
            const SurfaceMotion              motion = SurfaceMotion::carried,
            const Memory                     memory = Memory::none) const;

    /// Where points of the surface are after dt, or would be if there were no walls.
    std::vector<Point<dim>>
    move_surface(const std::vector<Point<dim>> &x) const
    {
      Guesses none;
      return Tracer<dim>(*old.mesh).path_ends(x, velocity.surface, dt, none);
    }

    /// The old velocity, continued in time to the end of the step, at the nodes of a mesh.
    NodeVector<dim>
    velocity_at_end(const Mesh<dim> &mesh) const;

    /// The markers after dt, still on the ranks they came from.
    std::vector<Marker<dim>>
    move_markers() const
    {
      return moved_markers<dim>(old, velocity.surface, dt);
    }

    /// The same of the material points of a state that has some.
    std::vector<MaterialPoint<dim>>
    move_material() const
    {
      return moved_material<dim>(old, velocity.surface, dt);
    }

    /// The same of what liquid the cells have; it may go into walls.
    std::vector<Parcel<dim>>
    move_parcels() const
    {
      return moved_parcels<dim>(domain, velocity.surface, dt);
    }

    /// Where what the surface's velocity brings to points of the new time was, and phi there.
    struct Feet
    {
      std::vector<Point<dim>> from;
      std::vector<double>     phi;
    };

    Feet
    feet(const std::vector<Point<dim>> &x) const;

  private:
    /// What is known at the nodes of the old mesh at those of another.
    NodeVector<dim>
    at_nodes_of(const Mesh<dim> &mesh, const NodeVector<dim> &v) const;

    /// Fields that @p velocity carries on for a time (s), as the scheme does.
    CarriedFields<dim>
    carried(std::vector<NodeField<dim>> &&fields,
            const VelocityInStep<dim>   &velocity,
            const double                 time,
            const double                 reach) const;

    void
    advance_nodes(State<dim> &state, const double reach) const;

    const Parameters            prm;
    const State<dim>           &old;
    const LiquidDomain<dim>    &domain;
    const SurfaceGeometry<dim> &surface;
    const BackwardDifference    difference;
    const double                dt;
    const StepVelocity<dim>     velocity; ///< at nodes
  };
} // namespace treacle

#endif
