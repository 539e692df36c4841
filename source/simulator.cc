// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/simulator.h>
#include <treacle/surface/emission.h>
#include <treacle/surface/material_extension.h>
#include <treacle/surface/redistance.h>
#include <treacle/transport/remesh.h>

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
    time_step.add_parameters(handler);
    scene.add_parameters(handler, n_liquids, n_solids, n_emitters);
    steps.add_parameters(handler);
    imported.add_parameters(handler);
    mesh.add_parameters(handler);
    tracking.add_parameters(handler);
    advection.add_parameters(handler);
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

    template <int dim>
    typename Octree<dim>::Parameters
    with_box(typename Octree<dim>::Parameters mesh, const Scene<dim> &scene)
    {
      mesh.lower_corner = scene.lower_corner();
      mesh.upper_corner = scene.upper_corner();
      return mesh;
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
    , time_step(prm.time_step)
    , tracking(prm.tracking)
    , dynamics(prm.dynamics, prm.steps)
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
        check_walls();
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
              std::to_string(state->mesh->cells->size()) + " cells, " + description_of_mesh());

    while (frame < time_step.n_frames())
      {
        step(time_step.next(*state, *domain, frame + 1));
        if (state->time >= time_step.frame_time(frame + 1) * (1 - 1e-12))
          {
            ++frame;
            output_frame();
          }
        log->progress(state->time / prm.time_step.end_time);
      }
    log->line(timing.summary());
    timing.write(prm.output_directory);
  }

  template <int dim>
  void
  Simulator<dim>::start()
  {
    state = std::make_unique<State<dim>>(
      imported ? imported : initial_mesh<dim>(comm, with_box(prm.mesh, scene), scene));
    const Mesh<dim> &mesh = *state->mesh;
    reach                 = time_step.reach(mesh);
    std::string error;
    check_bodies();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      state->phi.local_element(node) = scene.liquid_distance(mesh.node_position[node]);
    state->phi.update_ghost_values();
    redistance(*state, reach);
    if (scene.has_advected_material())
      {
        set_initial_material(*state, scene);
        extend_material(*state, n_layers());
      }
    tracking.reseed(*state, scene);

    domain = dynamics.liquid_domain(*state, scene);
    volume = domain->total_volume();
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain->is_liquid_face(f))
        keep_error(error, [&] {
          state->u.local_element(f) =
            scene.initial_velocity(mesh.face_centre[f]) * mesh.face_normal[f];
        });
    throw_first(comm, error);
    state->u.update_ghost_values();
    dynamics.reconstruct(*state, *domain, reach);

    // nothing is written before all that can be wrong with the scene was seen
    log        = std::make_unique<Log>(comm, prm.output_directory, false);
    statistics = std::make_unique<Statistics<dim>>(comm, prm.output_directory, probes);
    checkpoint.remove();
    write_parameters();
    statistics->add_row(*state, *domain, StepInfo<dim>());
    output_frame();
  }

  template <int dim>
  void
  Simulator<dim>::resume()
  {
    auto [loaded, progress] = imported ?
                                checkpoint.load(imported) :
                                checkpoint.load(with_box(prm.mesh, scene), &leaf_weight<dim>);
    state                   = std::make_unique<State<dim>>(std::move(loaded));
    frame                   = progress.frame;
    require(std::abs(time_step.frame_time(frame) - state->time) <= 1e-9 * state->time,
            "Frame interval: it must be the one of the run that is resumed, for frame " +
              std::to_string(frame) + " is at t = " + digits(state->time) + " s.");
    require(state->material.has_value() == scene.has_advected_material(),
            "Material/Transport: it must be the one of the run that is resumed.");
    if (state->before &&
        (!time_step.is_second_order() || state->before->v.has_value() != prm.steps.advection))
      state->before.reset();
    volume                  = progress.scalars.at("volume");
    reach                   = time_step.reach(*state->mesh);
    domain = dynamics.liquid_domain(*state, scene);
    log        = std::make_unique<Log>(comm, prm.output_directory, true);
    statistics = std::make_unique<Statistics<dim>>(comm, prm.output_directory, probes);
    statistics->resume(*state, *domain);
    write_parameters();
    log->line("resumed at t = " + digits(state->time) + " s, frame " +
              std::to_string(frame));
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
  void
  Simulator<dim>::check_bodies() const
  {
    const Mesh<dim> &mesh         = *state->mesh;
    const auto       check_finite = [&](const std::string &name, const auto &distance) {
      const auto &x      = mesh.node_position;
      const bool  finite = std::all_of(x.begin(), x.end(), [&](const Point<dim> &p) {
        return std::isfinite(distance(p));
      });
      require(Utilities::MPI::min(finite ? 1 : 0, comm) == 1,
              name + ": the Expression is not finite somewhere in the box: mend it.");
    };
    const auto check = [&](const std::string &name, const auto &distance, const double time) {
      check_finite(name, distance);
      bool        in_box = false, outside_solids = false;
      std::string error;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (const Point<dim> &x = mesh.node_position[node]; distance(x) < 0)
          {
            in_box = true;
            keep_error(error, [&] {
              outside_solids = outside_solids || scene.solid_distance(x, time) > 0;
            });
          }
      throw_first(comm, error);
      require(Utilities::MPI::max(in_box ? 1 : 0, comm) == 1,
              name + (imported ? " lies outside the mesh, or is smaller than its cells: move it, "
                                 "or change Mesh/File." :
                                 " lies outside the box, or is smaller than the cells: move it, "
                                 "change Domain/Lower corner and Upper corner, or raise "
                                 "Mesh/Surface level."));
      require(Utilities::MPI::max(outside_solids ? 1 : 0, comm) == 1,
              name + " lies inside a solid: move one of them.");
    };
    if (scene.has_solids())
      check_finite("Solids", [&](const Point<dim> &x) { return scene.solid_distance(x, 0); });
    for (unsigned int k = 0; k < scene.n_liquids(); ++k)
      check(
        "Liquid " + std::to_string(k + 1),
        [&](const Point<dim> &x) { return scene.liquid_distance(k, x); },
        0);
    for (const Emitter<dim> &emitter : scene.emitters())
      check(
        emitter.where,
        [&](const Point<dim> &x) { return emitter.signed_distance(x); },
        emitter.start_time);
  }

  template <int dim>
  void
  Simulator<dim>::check_walls() const
  {
    std::string error;
    if (!scene.no_slip(Walls<dim>::oblique))
      for (LocalIndex f = 0; f < imported->n_owned_faces(); ++f)
        if (imported->face_side[f] == Walls<dim>::oblique)
          {
            error = "Domain/Wall condition: liquid slips along walls normal to an axis only, and "
                    "the mesh \"" + prm.imported.file +
                    "\" has others; let the default be no slip, as in \"default: no slip; top: "
                    "free slip\".";
            break;
          }
    throw_first(comm, error);
  }

  template <int dim>
  std::string
  Simulator<dim>::description_of_mesh() const
  {
    const Mesh<dim> &mesh = *state->mesh;
    if (!imported)
      return "leaf edge " + digits(mesh.finest_size()) + " m";
    return "mesh " + prm.imported.file + " of mean size " + digits(mesh.finest_size()) + " m, " +
           std::to_string(mesh.n_clamped_dual_lengths) + " of " +
           std::to_string(mesh.faces->size()) + " dual lengths clamped";
  }

  template <int dim>
  void
  Simulator<dim>::move_surface(const double dt)
  {
    const Advection<dim> advection(prm.advection, *state, *domain, dt);
    const auto           markers = [&] {
      const auto section = timing.section("markers");
      return advection.move_markers();
    }();
    const auto mesh = [&] {
      const auto section = timing.section("mesh");
      return mesh_for_next_surface(*state, scene, advection, markers, dt);
    }();
    info.rebuilt = mesh != state->mesh;
    State<dim> next = [&] {
      const auto section = timing.section("advection");
      State<dim> state = advection.advance(mesh, reach);
      if (remembers())
        state.before = advection.velocity_before(*mesh);
      return state;
    }();
    {
      const auto section = timing.section("surface");
      next.markers = to_owners(*mesh, markers);
      info.emitted = emit(next, scene, dt);
      volume += info.emitted;
      tracking.advance(next, scene, reach, volume);
      if (next.material)
        extend_material(next, n_layers());
    }
    if (!info.rebuilt) // the first guess of the next solves
      next.v = state->v;
    next.v.update_ghost_values();
    domain.reset();
    // not *state = ...: a vector that is assigned to may keep its old ghosts
    state = std::make_unique<State<dim>>(std::move(next));
  }

  template <int dim>
  bool
  Simulator<dim>::remembers() const
  {
    return time_step.is_second_order() && !scene.has_switch_at(state->time);
  }

  template <int dim>
  void
  Simulator<dim>::keep_surface(const double dt)
  {
    const auto section = timing.section("advection");
    if (!prm.steps.advection)
      {
        stay(dt);
        return;
      }
    const Advection<dim> advection(prm.advection, *state, *domain, dt);
    State<dim>           next = advection.advance(state->mesh, reach);
    if (remembers())
      next.before = advection.velocity_before(*state->mesh);
    next.phi     = state->phi;
    next.v       = state->v; // the first guess of the next solves
    next.markers = std::move(state->markers);
    next.phi.update_ghost_values();
    next.v.update_ghost_values();
    domain.reset();
    state = std::make_unique<State<dim>>(std::move(next));
  }

  template <int dim>
  void
  Simulator<dim>::stay(const double dt)
  {
    const BackwardDifference difference(dt, *state);
    VelocityBefore<dim>      before{dt, {}, state->u};
    state->u.zero_out_ghost_values();
    if (difference.before != 0)
      state->u.sadd(difference.now, difference.before, *state->before->u);
    before.u->update_ghost_values();
    state->u.update_ghost_values();
    state->before.reset();
    if (remembers())
      state->before = std::move(before);
    state->time += dt;
    ++state->step;
  }

  template <int dim>
  void
  Simulator<dim>::step(const double dt)
  {
    Timer wall;
    if (scene.has_switch_at(state->time))
      state->before.reset();
    const BackwardDifference difference(dt, *state);
    info    = StepInfo<dim>();
    info.dt = dt;
    scene.check_solids(state->time + dt);
    if (prm.steps.surface)
      move_surface(dt);
    else
      keep_surface(dt);
    {
      const auto section = timing.section("liquid domain");
      domain = dynamics.liquid_domain(*state, scene);
    }
    info.dynamics  = dynamics.advance(*state, *domain, difference.step, reach, timing);
    maximum_speed(*state, *domain); // must be finite
    info.wall_time = wall.wall_time();
    report();
  }

  template <int dim>
  void
  Simulator<dim>::report()
  {
    statistics->add_row(*state, *domain, info);
    char text[200];
    std::snprintf(text,
                  sizeof text,
                  "step %5u  t %.6f s  dt %.2e s  %8llu cells%s  speed %.2e m/s  "
                  "viscosity %3u  pressure %3u  %.2f s",
                  state->step,
                  state->time,
                  info.dt,
                  static_cast<unsigned long long>(state->mesh->cells->size()),
                  info.rebuilt ? " (new)" : "      ",
                  statistics->last("Maximum speed (m/s)"),
                  info.dynamics.viscosity_iterations,
                  info.dynamics.pressure_iterations,
                  info.wall_time);
    log->line(text);
    if (info.dynamics.fallbacks > 0)
      log->line("warning: the coupled solve stagnated; this step was split with first projection. A "
                "smaller Maximum time step, or Linear solvers/Coupled/Maximum iterations, may help.");
  }

  template <int dim>
  void
  Simulator<dim>::output_frame()
  {
    const auto section = timing.section("output");
    surface_writer.write(*state, *domain, prm.output_directory, frame);
    mesh_writer.write(*state, *domain, prm.output_directory, frame);
    if (checkpoint.is_due(frame))
      checkpoint.write(*state, {frame, {{"volume", volume}}});
  }

  template class Simulator<2>;
  template class Simulator<3>;
} // namespace treacle
