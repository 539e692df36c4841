// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_time_step_h
#define treacle_transport_time_step_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/mesh/surface_size.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// A step, and what keeps it from being longer.
  struct StepSize
  {
    enum class Bound
    {
      cfl,       ///< leaves that are crossed
      weight,    ///< what a fall from its speed would cross
      change,    ///< how fast the velocity changes
      growth,    ///< twice the step before
      maximum,   ///< Maximum time step
      frame      ///< or where an emitter starts or stops
    };

    double dt; ///< s
    Bound  bound;
    double falling; ///< the longest step that is right even if nothing holds the liquid (s)

    /// For the log.
    std::string
    bounded_by() const;
  };



  /// Chooses dt: bounded by the CFL number, the maximum, and the next frame. Where viscosity holds
  /// the liquid, how its velocity changes counts, not gravity.
  template <int dim>
  class TimeStep
  {
  public:
    enum class Scheme
    {
      bdf2,
      backward_euler
    };

    struct Parameters
    {
      double end_time       = 1;
      double frame_interval = 0.04;
      double cfl            = 3;
      double maximum        = 0; ///< s; 0: as longest_free() and longest_held() say

      Scheme scheme = Scheme::bdf2;

      void
      add_parameters(ParameterHandler &prm);
    };

    /// Throws a UserError if the largest step is neither 0 nor one that time can take.
    explicit TimeStep(const Parameters &parameters);

    /// What a liquid does that is to be followed in time.
    struct Motion
    {
      bool moves;      ///< surface or velocity
      bool is_coupled; ///< viscosity and pressure are solved for together, with the weight to come
    };

    /// The step from state.time; steps end exactly on frames. Throws a UserError
    /// on all ranks where velocity or gravity is not finite. Collective.
    StepSize
    next(const State<dim>        &state,
         const LiquidDomain<dim> &domain,
         const unsigned int       frame,
         const Motion            &motion) const;

    /// How far from the surface the velocity must be known for the step from state.time (m): paths end in the liquid, or where they
    /// began from it as far as before, for the air goes along with the surface. Throws like next(). Collective.
    double
    reach(const State<dim> &state, const LiquidDomain<dim> &domain) const;

    /// The same for any step.
    double
    largest_reach(const Mesh<dim> &mesh) const
    {
      return prm.cfl * largest_surface_size(mesh) + 3 * mesh.surface_size();
    }

    /// How far phi must be a distance, if the velocity is known up to @p reach (m): nodal gradients
    /// feel what it is further out (with 5 leaves an inviscid drop's axes change by 3e-5).
    static double
    reach_of_distance(const double reach, const Mesh<dim> &mesh)
    {
      return std::max(reach, 6 * mesh.surface_size());
    }

    /// The velocity of the step before is part of the state then.
    bool
    is_second_order() const
    {
      return prm.scheme == Scheme::bdf2;
    }

    /// The longest step that there may be, of liquid that moves as it likes (s).
    double
    longest_free() const
    {
      return std::min(prm.maximum > 0 ? prm.maximum : default_maximum, prm.frame_interval);
    }

    /// The same of liquid that viscosity holds, and nothing sets in motion within a step.
    double
    longest_held(const Scene<dim> &scene) const
    {
      return prm.maximum > 0 || scene.is_driven() ? longest_free() : prm.frame_interval;
    }

    double
    frame_time(const unsigned int frame) const
    {
      return std::min(frame * prm.frame_interval, prm.end_time);
    }

    /// The last frame's number.
    unsigned int
    n_frames() const
    {
      return static_cast<unsigned int>(std::ceil(prm.end_time / prm.frame_interval - 1e-9));
    }

  private:
    static constexpr double default_maximum = 0.04; // s

    /// What the liquid's motion allows.
    void
    find_longest(const State<dim>        &state,
                 const LiquidDomain<dim> &domain,
                 const Motion            &motion,
                 StepSize                &size) const;

    const Parameters prm;
  };

  /// Largest speed of an active node over all ranks (m/s). Throws a UserError on all of them
  /// if it is not finite. Collective.
  template <int dim>
  double
  maximum_speed(const State<dim> &state, const LiquidDomain<dim> &domain);

  /// Leaves that liquid crosses in a second (1/s), at most, each of those that are there: inside the liquid
  /// they count as no larger than the largest that the surface passes through. Collective.
  template <int dim>
  double
  fastest_crossing(const LiquidDomain<dim> &domain, const NodeVector<dim> &v);
} // namespace treacle

#endif
