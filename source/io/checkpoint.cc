// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/io/checkpoint.h>
#include <treacle/io/saved_mesh.h>
#include <treacle/io/saved_state.h>

#include <filesystem>
#include <fstream>
#include <iomanip>

namespace treacle
{
  namespace fs = std::filesystem;

  template <int dim>
  void
  Checkpoint<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Checkpoint");
    prm.add_parameter("Interval",
                      interval,
                      "Frames from one checkpoint to the next; 0: never.",
                      Patterns::Integer(0));
    prm.leave_subsection();
  }

  template <int dim>
  Checkpoint<dim>::Checkpoint(const MPI_Comm    &comm,
                              const Parameters  &parameters,
                              const std::string &output_directory)
    : comm(comm)
    , interval(parameters.interval)
    , path(output_directory + "/checkpoint")
  {}

  namespace
  {
    /// The file that is written last: without it a checkpoint is not complete.
    std::string
    info_file(const std::string &directory)
    {
      return directory + "/info";
    }

    /// Not complete any more at once, then gone.
    void
    discard(const std::string &directory)
    {
      std::error_code ignored;
      fs::remove(info_file(directory), ignored);
      fs::remove_all(directory, ignored);
    }

    const std::string scalar_prefix = "Scalar ", format_version = "10";

    template <int dim>
    void
    write_info(std::ostream                             &out,
               const Mesh<dim>                          &mesh,
               const typename Checkpoint<dim>::Progress &progress,
               const std::string                        &on_mesh,
               const std::string                        &on_state)
    {
      const auto &[lower, upper] = mesh.box().get_boundary_points();
      out << std::setprecision(17) << "Format = " << format_version << "\nDimension = " << dim
          << "\nRanks = " << Utilities::MPI::n_mpi_processes(mesh.communicator())
          << "\nFrame = " << progress.frame << '\n'
          << on_state << "Mesh type = " << (mesh.is_lattice() ? "lattice" : "file")
          << "\nMesh fingerprint = " << on_mesh << "\nCells = " << mesh.cells->size()
          << "\nNodes = " << mesh.nodes->size() << "\nLower corner = " << to_text(lower, 17)
          << "\nUpper corner = " << to_text(upper, 17) << '\n';
      if (mesh.is_lattice())
        out << "Root cells = " << mesh.octree().parameters().root_cells
            << "\nSurface level = " << mesh.octree().parameters().surface_level
            << "\nSize factor = " << mesh.octree().size_factor() << '\n';
      for (const auto &[name, value] : progress.scalars)
        out << scalar_prefix << name << " = " << value << '\n';
    }
  } // namespace

  template <int dim>
  void
  Checkpoint<dim>::write(const State<dim> &state, const Progress &progress) const
  {
    const bool        is_writer = Utilities::MPI::this_mpi_process(comm) == 0;
    const std::string fresh     = path + ".new";
    if (is_writer)
      discard(fresh);
    create_directory(comm, fresh);
    if (state.mesh->is_lattice())
      write_leaves(state.mesh->octree(), fresh + "/leaves");
    const std::string on_state = write_state(state, fresh);
    const std::string on_mesh  = fingerprint(*state.mesh);
    replace_file(comm, info_file(fresh), [&](std::ostream &out) {
      write_info(out, *state.mesh, progress, on_mesh, on_state);
    });
    throw_first(comm, is_writer ? replace() : "");
  }

  template <int dim>
  std::string
  Checkpoint<dim>::replace() const
  {
    std::error_code   error;
    const std::string old = path + ".old";
    discard(old);
    if (fs::exists(path))
      fs::rename(path, old, error);
    if (!error)
      fs::rename(path + ".new", path, error);
    if (error)
      return "The checkpoint \"" + path + "\" cannot be replaced: " + error.message() + ".";
    discard(old);
    return "";
  }

  template <int dim>
  std::pair<std::string, CheckpointInfo>
  Checkpoint<dim>::find(const std::string &mesh_type) const
  {
    // the newest that is complete; between two renames it is not at its place
    std::string directory, text;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      for (const char *suffix : {"", ".new", ".old"})
        if (std::ifstream file(info_file(path + suffix)); file && directory.empty())
          {
            directory = path + suffix;
            text.assign(std::istreambuf_iterator<char>(file), {});
          }
    directory = Utilities::MPI::broadcast(comm, directory);
    text      = Utilities::MPI::broadcast(comm, text);
    require(!directory.empty(),
            "The run cannot be resumed: there is no checkpoint \"" + path +
              "\". Start it without --resume.");

    const CheckpointInfo info(text, info_file(directory));
    require(info.get("Format") == format_version,
            "The run cannot be resumed: its checkpoint \"" + directory + "\" has the format " +
              info.get("Format") + ", of another version of Treacle; this one reads format " +
              format_version + ". Resume it with that version, or start a new run.");
    info.require_same("Dimension", "Dimension", std::to_string(dim));
    info.require_same("Mesh type", "Mesh/Type", mesh_type);
    return {directory, info};
  }

  template <int dim>
  std::pair<State<dim>, typename Checkpoint<dim>::Progress>
  Checkpoint<dim>::load(const typename Octree<dim>::Parameters &parameters) const
  {
    const auto [directory, info] = find("lattice");
    info.require_same("Lower corner",
                      "Domain/Lower corner",
                      to_text(parameters.lower_corner, 17));
    info.require_same("Upper corner",
                      "Domain/Upper corner",
                      to_text(parameters.upper_corner, 17));
    info.require_same("Root cells",
                      "Mesh/Root cells",
                      std::to_string(parameters.root_cells));
    info.require_same("Surface level",
                      "Mesh/Surface level",
                      std::to_string(parameters.surface_level));

    const auto mesh = std::make_shared<const Mesh<dim>>(
      read_octree<dim>(comm, directory + "/leaves", parameters, info.number("Size factor")));
    require(info.get("Mesh fingerprint") == fingerprint(*mesh),
            "The checkpoint \"" + directory + "\" is damaged: its leaves do not make the mesh "
            "that was saved.");
    return load(mesh, directory, info);
  }

  template <int dim>
  std::pair<State<dim>, typename Checkpoint<dim>::Progress>
  Checkpoint<dim>::load(std::shared_ptr<const Mesh<dim>> imported) const
  {
    const auto [directory, info] = find("file");
    info.require_same("Cells",
                      "the number of cells of Mesh/File",
                      std::to_string(imported->cells->size()));
    require(info.get("Mesh fingerprint") == fingerprint(*imported),
            "The run cannot be resumed: Mesh/File has changed since the checkpoint \"" +
              directory + "\" was written: it has other vertices or cells, or another order of "
              "them. Restore the file, or start a new run.");
    return load(imported, directory, info);
  }

  template <int dim>
  std::pair<State<dim>, typename Checkpoint<dim>::Progress>
  Checkpoint<dim>::load(std::shared_ptr<const Mesh<dim>> mesh,
                        const std::string               &directory,
                        const CheckpointInfo            &info) const
  {
    State<dim> state = read_state(std::move(mesh), directory, info);
    Progress   progress;
    progress.frame   = info.count("Frame");
    progress.scalars = info.scalars(scalar_prefix);
    return {std::move(state), std::move(progress)};
  }

  template <int dim>
  void
  Checkpoint<dim>::remove() const
  {
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      for (const char *suffix : {"", ".new", ".old"})
        discard(path + suffix);
    MPI_Barrier(comm);
  }

  template class Checkpoint<2>;
  template class Checkpoint<3>;
} // namespace treacle
