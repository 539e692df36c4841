// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_transport_h
#define treacle_transport_transport_h

#include <treacle/base/timing.h>
#include <treacle/surface/liquid.h>
#include <treacle/surface/surface_tracking.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/lost_volume.h>
#include <treacle/transport/time_step.h>

#include <optional>

namespace treacle
{
  /// Moves the liquid on by a step: surface forward, fields back along their paths, and the
  /// mesh after the surface. What dynamics need is in the liquid then, but for its domain.
  template <int dim>
  class Transport
  {
  public:
    struct Parameters
    {
      typename TimeStep<dim>::Parameters        time_step;
      typename SurfaceTracking<dim>::Parameters tracking;
      typename Advection<dim>::Parameters       advection;
    };

    /// The scene must outlive this object.
    Transport(const Parameters &parameters, const Scene<dim> &scene)
      : tracking(parameters.tracking)
      , time_step(parameters.time_step)
      , prm(parameters)
      , scene(scene)
    {}

    const SurfaceTracking<dim> tracking;
    const TimeStep<dim>        time_step;

    struct Info
    {
      bool   rebuilt = false; ///< the mesh is new
      double emitted = 0;     ///< volume from emitters (m^dim)

      /// What went into walls and solids, and how much of it is missing now (m^dim); 0 if that is
      /// not worth while to push out.
      std::vector<LostVolume<dim>> lost;
      double                       missing = 0;
      /// How much of the volume the surface won otherwise, before it was corrected.
      double drift = 0;
      /// What was lost otherwise, if it is worth while, over what the surface has moved over and drains took.
      double swallowed = 0;
    };

    /// The surface moves, and all with it; @p volume is what the liquid had (m^dim). Nothing moves if more
    /// than @p most_lost (m^dim) would go into walls and solids.
    std::optional<Info>
    move_liquid(Liquid<dim>              &liquid,
                const BackwardDifference &difference,
                const double              volume,
                const double              most_lost,
                Timing                   &timing) const;

    /// The surface and its material points move on by the velocity of @p pushed, and nothing else, until
    /// they have swept what is missing after a step (in about a second); with volume correction to @p volume in all (m^dim).
    void
    displace(Liquid<dim>       &liquid,
             const Liquid<dim> &pushed,
             const Info        &moved,
             const double       volume) const;

    /// Velocity and material move on, but neither surface nor mesh.
    void
    move_velocity(Liquid<dim>              &liquid,
                  const BackwardDifference &difference,
                  Timing                   &timing) const;

    /// Nothing moves.
    void
    stay(State<dim> &state, const BackwardDifference &difference) const;

    /// The velocity a step of @p dt before now, had it changed as it does until @p ahead, after
    /// such a step: 2 now - ahead.
    static VelocityBefore<dim>
    mirrored(const Liquid<dim> &now,
             const Liquid<dim> &ahead,
             const double       dt,
             const bool         is_advected);

    /// Velocity continued into the air as far as the liquid may go in a step.
    void
    extend_velocity(Liquid<dim> &liquid) const;

    /// Material that is carried, by its points where it jumps, and as far into the air.
    void
    settle_material(State<dim> &state, const MeshData<dim> &data) const;

  private:
    /// State of the next time on a mesh, without markers.
    std::unique_ptr<State<dim>>
    carry(const State<dim>                       &old,
          const Advection<dim>                   &advection,
          const std::shared_ptr<const Mesh<dim>> &mesh,
          const double                            reach,
          const typename Advection<dim>::SurfaceMotion motion) const;

    /// Is the velocity of now of use to the step after this one? Not before an emitter
    /// starts or stops.
    bool
    remembers(const double time) const
    {
      return time_step.is_second_order() && !scene.has_switch_at(time);
    }

    const Parameters  prm;
    const Scene<dim> &scene;
  };
} // namespace treacle

#endif
