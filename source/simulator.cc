// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/files.h>
#include <treacle/fields/initial_state.h>
#include <treacle/simulator.h>
#include <treacle/surface/carried_material.h>
#include <treacle/surface/redistance.h>
#include <treacle/transport/initial_mesh.h>

#include <cstdio>
#include <ostream>

namespace treacle
{
  template <int dim>
  void
  Simulator<dim>::Parameters::add_parameters(ParameterHandler  &handler,
                                             const unsigned int n_liquids,
                                             const unsigned int n_solids,
                                             const unsigned int n_emitters,
                                             const unsigned int n_probes)
  {
    handler.add_parameter("Dimension", dimension, "Of space.", Patterns::Integer(2, 3));
    handler.add_parameter("Output directory",
                          output_directory,
                          "Where everything that a run writes goes.");
    transport.time_step.add_parameters(handler);
    scene.add_parameters(handler, n_liquids, n_solids, n_emitters);
    steps.add_parameters(handler);
    imported.add_parameters(handler);
    mesh.add_parameters(handler);
    transport.tracking.add_parameters(handler);
    transport.advection.add_parameters(handler);
    liquid_domain.add_parameters(handler);
    dynamics.add_parameters(handler);
    mesh_writer.add_parameters(handler);
    surface_writer.add_parameters(handler);
    probes.add_parameters(handler, n_probes);
    checkpoint.add_parameters(handler);
  }

  namespace
  {
    template <int dim>
    std::shared_ptr<const Mesh<dim>>
    imported_mesh(const MPI_Comm &comm, const typename ImportedMesh<dim>::Parameters &prm)
    {
      return prm.is_imported() ? std::make_shared<const Mesh<dim>>(comm, prm.file) : nullptr;
    }

    /// A mesh from a file has its own box.
    template <int dim>
    typename Simulator<dim>::Parameters
    in_box_of_mesh(typename Simulator<dim>::Parameters prm, const Mesh<dim> *mesh)
    {
      if (mesh != nullptr)
        std::tie(prm.scene.lower_corner, prm.scene.upper_corner) =
          mesh->box().get_boundary_points();
      return prm;
    }
  } // namespace

  template <int dim>
  Simulator<dim>::Simulator(const MPI_Comm    &comm,
                            const Parameters  &parameters,
                            const std::string &parameters_as_used)
    : comm(comm)
    , imported(imported_mesh<dim>(comm, parameters.imported))
    , prm(in_box_of_mesh(parameters, imported.get()))
    , parameters_as_used(parameters_as_used)
    , scene(prm.scene, comm)
    , movement(prm.transport, scene)
    , time_step(movement.time_step)
    , dynamics(prm.dynamics, prm.steps, time_step.longest_free())
    , stepping(scene, prm.steps, prm.liquid_domain, movement, dynamics, timing)
    , mesh_writer(prm.mesh_writer)
    , surface_writer(prm.surface_writer)
    , probes(prm.probes)
    , checkpoint(comm, prm.checkpoint, prm.output_directory)
    , timing(comm)
  {
    prm.steps.check(scene);
    if (imported)
      {
        probes.check(*imported);
        check_walls(*imported, scene, prm.imported.file);
      }
    else
      {
        with_box(prm.mesh, scene).check();
        probes.check(scene);
      }
  }

  template <int dim>
  void
  Simulator<dim>::run(const bool resume)
  {
    if (resume)
      this->resume();
    else
      start();
    log->line("Treacle " TREACLE_VERSION ", " + std::to_string(dim) + "D, " +
              std::to_string(Utilities::MPI::n_mpi_processes(comm)) + " ranks, " +
              std::to_string(liquid.state->mesh->cells->size()) + " cells, " + description_of_mesh());
    warnings->of_frame(liquid);

    while (frame < time_step.n_frames())
      {
        // what was before an emitter starts or stops is of no use behind it
        if (scene.has_switch_at(liquid.state->time))
          liquid.state->before.reset();
        const StepSize size = time_step.next(
          *liquid.state, *liquid.domain, frame + 1, {prm.steps.moves(), dynamics.is_coupled()});
        info = stepping.advance(liquid, volume, size);
        report(size);
        if (liquid.state->time >= time_step.frame_time(frame + 1) * (1 - 1e-12))
          {
            ++frame;
            output_frame();
            warnings->of_frame(liquid);
          }
        log->progress(liquid.state->time / prm.transport.time_step.end_time);
      }
    log->line(timing.summary());
    timing.write(prm.output_directory);
  }

  template <int dim>
  void
  Simulator<dim>::start()
  {
    const auto section = timing.section("set-up");
    const auto mesh    = imported ? imported : initial_mesh<dim>(comm, prm.mesh, scene);
    check_bodies(*mesh, scene);
    liquid.mesh_data  = std::make_shared<const MeshData<dim>>(*mesh, scene);
    liquid.state      = std::make_unique<State<dim>>(mesh);
    State<dim> &state = *liquid.state;
    set_initial_level_set(state, scene);
    redistance(state, time_step.largest_reach(*mesh), liquid.mesh_data->solid_distance(state.time));
    if (scene.has_advected_material())
      {
        set_initial_material(state, *liquid.mesh_data);
        movement.settle_material(state, *liquid.mesh_data);
      }
    liquid.surface = movement.tracking.begin(state, *liquid.mesh_data);
    liquid.find(prm.liquid_domain);
    volume = liquid.domain->total_volume();
    set_initial_velocity(state, *liquid.domain);
    dynamics.admit(liquid, timing);
    movement.extend_velocity(liquid);

    // nothing is written before all that can be wrong with the scene was seen
    open_output(false);
    checkpoint.remove();
    statistics->add_row(state, *liquid.domain, StepInfo<dim>());
    output_frame();
  }

  template <int dim>
  void
  Simulator<dim>::open_output(const bool resume)
  {
    log        = std::make_unique<Log>(comm, prm.output_directory, resume);
    warnings   = std::make_unique<Warnings>(*log,
                                          imported ? "make the cells of Mesh/File smaller." :
                                          prm.mesh.coarsest_at_surface() < prm.mesh.surface_level ?
                                                     "raise Mesh/Coarsest surface level." :
                                                     "raise Mesh/Surface level.");
    statistics = std::make_unique<Statistics<dim>>(comm, prm.output_directory, probes);
    if (resume)
      statistics->resume(*liquid.state, *liquid.domain);
    write_parameters();
  }

  template <int dim>
  void
  Simulator<dim>::resume()
  {
    auto [state, progress] =
      imported ? checkpoint.load(imported) : checkpoint.load(with_box(prm.mesh, scene));
    frame = progress.frame;
    require(std::abs(time_step.frame_time(frame) - state.time) <= 1e-9 * state.time,
            "Frame interval: it must be the one of the run that is resumed, for frame " +
              std::to_string(frame) + " is at t = " + digits(state.time) + " s.");
    require(state.material.has_value() == scene.has_advected_material(),
            "Material/Transport: it must be the one of the run that is resumed.");
    if (state.before &&
        (!time_step.is_second_order() || state.before->v.has_value() != prm.steps.advection))
      state.before.reset();
    volume = progress.scalars.at("volume");
    liquid = Liquid<dim>::of(std::make_shared<State<dim>>(std::move(state)), scene, prm.liquid_domain);
    open_output(true);
    log->line("resumed at t = " + digits(liquid.state->time) + " s, frame " + std::to_string(frame));
  }

  template <int dim>
  void
  Simulator<dim>::write_parameters() const
  {
    replace_file(comm, prm.output_directory + "/parameters.prm", [&](std::ostream &out) {
      out << parameters_as_used;
      if (imported)
        out << "\n# the box of the mesh\nsubsection Domain\n  set Lower corner = "
            << to_text(prm.scene.lower_corner, 17)
            << "\n  set Upper corner = "
            << to_text(prm.scene.upper_corner, 17) << "\nend\n";
    });
  }

  template <int dim>
  std::string
  Simulator<dim>::description_of_mesh() const
  {
    const Mesh<dim> &mesh = *liquid.state->mesh;
    if (!imported)
      return "leaf edge " + digits(mesh.finest_size()) + " m";
    return "mesh " + prm.imported.file + " of mean size " + digits(mesh.finest_size()) + " m, " +
           std::to_string(mesh.n_clamped_dual_lengths) + " of " +
           std::to_string(mesh.faces->size()) + " dual lengths clamped";
  }

  template <int dim>
  void
  Simulator<dim>::report(const StepSize &size)
  {
    statistics->add_row(*liquid.state, *liquid.domain, info);
    char text[200];
    std::snprintf(text,
                  sizeof text,
                  "step %5u  t %.6f s  dt %.2e s (%s)  %8llu cells%s  speed %.2e m/s  "
                  "viscosity %3u  pressure %3u  %.2f s",
                  liquid.state->step,
                  liquid.state->time,
                  info.dt,
                  size.bounded_by().c_str(),
                  static_cast<unsigned long long>(liquid.state->mesh->cells->size()),
                  info.rebuilt ? " (new)" : "      ",
                  statistics->last("Maximum speed (m/s)"),
                  info.dynamics.viscosity_iterations,
                  info.dynamics.pressure_iterations,
                  info.wall_time);
    log->line(text);
    const auto repeated = [&](const unsigned int times, const std::string &reason) {
      if (times > 0)
        log->line("the step was repeated " + std::to_string(times) + " times, shorter each time, for " + reason);
    };
    repeated(info.repetitions.volume,
             "the surface won or lost more than 1 % of the volume, or went too far into walls; left of it: " + digits(100 * info.drift) + " %");
    repeated(info.repetitions.motion, "what viscosity had held began to move");
    repeated(info.repetitions.energy,
             "the liquid gained more energy than forces can have given it; left of it: " +
               digits(100 * info.excess) + " %");
    warnings->of_step(info, statistics->last("Volume drift"));
  }

  template <int dim>
  void
  Simulator<dim>::output_frame()
  {
    const auto section = timing.section("output");
    surface_writer.write(*liquid.state, *liquid.domain, prm.output_directory, frame);
    mesh_writer.write(*liquid.state, *liquid.domain, prm.output_directory, frame);
    if (checkpoint.is_due(frame))
      checkpoint.write(*liquid.state, {frame, {{"volume", volume}}});
  }

  template class Simulator<2>;
  template class Simulator<3>;
} // namespace treacle
