// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_simulator_h
#define treacle_simulator_h

#include <treacle/base/log.h>
#include <treacle/base/timing.h>
#include <treacle/dynamics/dynamics.h>
#include <treacle/io/checkpoint.h>
#include <treacle/io/mesh_writer.h>
#include <treacle/io/statistics.h>
#include <treacle/io/surface_writer.h>
#include <treacle/mesh/imported_mesh.h>
#include <treacle/surface/surface_tracking.h>
#include <treacle/transport/advection.h>
#include <treacle/transport/time_step.h>

namespace treacle
{
  /// The loop over time steps.
  template <int dim>
  class Simulator
  {
  public:
    struct Parameters
    {
      unsigned int dimension        = dim;
      std::string  output_directory = "results/treacle";

      typename TimeStep<dim>::Parameters        time_step;
      typename Scene<dim>::Parameters           scene;
      StepSwitches                              steps;
      typename ImportedMesh<dim>::Parameters    imported;
      typename Octree<dim>::Parameters          mesh;
      typename SurfaceTracking<dim>::Parameters tracking;
      typename Advection<dim>::Parameters       advection;
      typename Dynamics<dim>::Parameters        dynamics;
      typename MeshWriter<dim>::Parameters      mesh_writer;
      typename SurfaceWriter<dim>::Parameters   surface_writer;
      typename Probes<dim>::Parameters          probes;
      typename Checkpoint<dim>::Parameters      checkpoint;

      /// @p prm writes into this object when it parses; do not move it before.
      void
      add_parameters(ParameterHandler  &prm,
                     const unsigned int n_liquids,
                     const unsigned int n_solids,
                     const unsigned int n_emitters = 0,
                     const unsigned int n_probes   = 0);
    };

    /// @p parameters_as_used is the text for the file parameters.prm. Throws a
    /// UserError, on all ranks alike, where the scene makes no sense.
    Simulator(const MPI_Comm    &comm,
              const Parameters  &parameters,
              const std::string &parameters_as_used);

    /// Run to the end time, from the start or from the last checkpoint.
    void
    run(const bool resume);

  private:
    void
    start();

    void
    resume();

    void
    write_parameters() const;

    void
    check_bodies() const;

    /// Of cells, from the surface into the air, that the liquid may cross in a step.
    unsigned int
    n_layers() const
    {
      return static_cast<unsigned int>(std::ceil(prm.time_step.cfl)) + 3;
    }

    void
    check_walls() const;

    std::string
    description_of_mesh() const;

    void
    step(const double dt);

    void
    move_surface(const double dt);

    /// Velocity and material move on, if they do, but neither surface nor mesh.
    void
    keep_surface(const double dt);

    /// Nothing moves.
    void
    stay(const double dt);

    /// Is the velocity of now of use to the step after this one? Not before an emitter
    /// starts or stops.
    bool
    remembers() const;

    void
    output_frame();

    void
    report();

    const MPI_Comm    comm;
    const std::shared_ptr<const Mesh<dim>> imported; ///< null if the mesh is a lattice
    const Parameters  prm;
    const std::string parameters_as_used;
    const Scene<dim>  scene;

    const TimeStep<dim>        time_step;
    const SurfaceTracking<dim> tracking;
    const Dynamics<dim>        dynamics;

    const MeshWriter<dim>            mesh_writer;
    const SurfaceWriter<dim>         surface_writer;
    const Probes<dim>                probes;
    const Checkpoint<dim>            checkpoint;
    Timing                           timing;
    std::unique_ptr<Log>             log;
    std::unique_ptr<Statistics<dim>> statistics;

    std::unique_ptr<State<dim>>        state;
    std::unique_ptr<LiquidDomain<dim>> domain;
    unsigned int                       frame  = 0; ///< the last one written
    double                             volume = 0; ///< that the liquid should have (m^dim)
    double                             reach  = 0; ///< of velocity and distance from the surface (m)
    StepInfo<dim>                      info;
  };
} // namespace treacle

#endif
