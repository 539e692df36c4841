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
#include <treacle/time_stepping.h>
#include <treacle/warnings.h>

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

      typename Scene<dim>::Parameters         scene;
      StepSwitches                            steps;
      typename ImportedMesh<dim>::Parameters  imported;
      typename Octree<dim>::Parameters        mesh;
      typename Transport<dim>::Parameters     transport;
      typename LiquidDomain<dim>::Parameters  liquid_domain;
      typename Dynamics<dim>::Parameters      dynamics;
      typename MeshWriter<dim>::Parameters    mesh_writer;
      typename SurfaceWriter<dim>::Parameters surface_writer;
      typename Probes<dim>::Parameters        probes;
      typename Checkpoint<dim>::Parameters    checkpoint;

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
    open_output(const bool resume);

    void
    write_parameters() const;

    std::string
    description_of_mesh() const;

    void
    output_frame();

    void
    report(const StepSize &size);

    const MPI_Comm    comm;
    const std::shared_ptr<const Mesh<dim>> imported; ///< null if the mesh is a lattice
    const Parameters  prm;
    const std::string parameters_as_used;
    const Scene<dim>  scene;

    const Transport<dim>      movement;
    const TimeStep<dim>      &time_step;
    const Dynamics<dim>       dynamics;
    const TimeStepping<dim>   stepping;

    const MeshWriter<dim>            mesh_writer;
    const SurfaceWriter<dim>         surface_writer;
    const Probes<dim>                probes;
    const Checkpoint<dim>            checkpoint;
    Timing                           timing;
    std::unique_ptr<Log>             log;
    std::unique_ptr<Warnings>        warnings;
    std::unique_ptr<Statistics<dim>> statistics;

    Liquid<dim>   liquid;
    unsigned int  frame  = 0; ///< the last one written
    double        volume = 0; ///< that the liquid should have (m^dim)
    StepInfo<dim> info;
  };
} // namespace treacle

#endif
