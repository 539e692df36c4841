// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/io/checkpoint.h>
#include <treacle/io/checkpoint_info.h>
#include <treacle/io/row_order.h>
#include <treacle/io/table_file.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

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

    const std::string scalar_prefix = "Scalar ";

    template <int dim>
    std::vector<int>
    numbers_of_leaves(const Octree<dim> &octree)
    {
      std::vector<int> result;
      for (unsigned int l = 0; l < octree.n_owned_leaves(); ++l)
        {
          const Leaf<dim> &leaf = octree.leaves()[l];
          result.insert(result.end(), leaf.origin.begin(), leaf.origin.end());
          result.push_back(leaf.level);
        }
      return result;
    }

    /// Level set, velocity (and that of the step before) and material at the nodes of a
    /// cell, face velocity (and that of the step before), pressure.
    template <int dim>
    unsigned int
    row_size(const bool with_material, const std::string &before)
    {
      return (dim + 1) * (dim + 2 + (with_material ? 2 : 0) +
                          (before == "nodes" ? dim : before == "faces" ? 1 : 0)) + 1;
    }

    template <int dim>
    std::string
    velocity_before(const State<dim> &state)
    {
      return !state.before ? "none" : state.before->v ? "nodes" : "faces";
    }

    bool
    has_material(const CheckpointInfo &info)
    {
      return info.get("Advected material") == "true";
    }

    template <int dim>
    unsigned int
    row_size(const CheckpointInfo &info)
    {
      return row_size<dim>(has_material(info), info.get("Velocity before"));
    }

    /// Call @p visit with each number of the rows of this rank's cells in turn.
    template <int dim, typename AnyState, typename Visit>
    void
    for_each_number(AnyState &state, const Visit &visit)
    {
      const Mesh<dim> &mesh = *state.mesh;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        {
          for (const LocalIndex node : mesh.cell_nodes[c])
            {
              visit(state.phi, node, mesh.n_owned_nodes());
              for (unsigned int d = 0; d < dim; ++d)
                visit(state.v.component[d], node, mesh.n_owned_nodes());
              if (state.before && state.before->v)
                for (unsigned int d = 0; d < dim; ++d)
                  visit(state.before->v->component[d], node, mesh.n_owned_nodes());
              if (state.material)
                {
                  visit(state.material->density, node, mesh.n_owned_nodes());
                  visit(state.material->viscosity, node, mesh.n_owned_nodes());
                }
            }
          for (const LocalIndex face : mesh.cell_faces[c])
            {
              visit(state.u, face, mesh.n_owned_faces());
              if (state.before && state.before->u)
                visit(*state.before->u, face, mesh.n_owned_faces());
            }
          visit(state.pressure, c, mesh.n_owned_cells());
        }
    }

    template <int dim>
    void
    write_info(std::ostream                             &out,
               const State<dim>                         &state,
               const std::uint64_t                       n_markers,
               const typename Checkpoint<dim>::Progress &progress)
    {
      const Mesh<dim> &mesh = *state.mesh;
      const auto      &box  = mesh.box().get_boundary_points();
      out << std::setprecision(17) << "Format = 3\nDimension = " << dim
          << "\nRanks = " << Utilities::MPI::n_mpi_processes(mesh.communicator())
          << "\nTime = " << state.time << "\nStep = " << state.step
          << "\nVelocity before = " << velocity_before(state)
          << "\nStep before = " << (state.before ? state.before->dt : 0.)
          << "\nFrame = " << progress.frame << "\nCells = " << mesh.cells->size()
          << "\nAdvected material = " << (state.material ? "true" : "false")
          << "\nMarkers = " << n_markers
          << "\nMesh type = " << (mesh.is_lattice() ? "lattice" : "file")
          << "\nLower corner = " << to_text(box.first, 17)
          << "\nUpper corner = " << to_text(box.second, 17) << '\n';
      if (mesh.is_lattice())
        out << "Root cells = " << mesh.octree().parameters().root_cells
            << "\nSurface level = " << mesh.octree().parameters().surface_level << '\n';
      else
        out << "Nodes = " << mesh.nodes->size() << '\n';
      for (const auto &[name, value] : progress.scalars)
        out << scalar_prefix << name << " = " << value << '\n';
    }
  } // namespace

  namespace
  {
    /// Each rank reads an even part; in this order a rank has its markers in the order in
    /// which it saved them.
    template <int dim>
    std::vector<Marker<dim>>
    load_markers(const Mesh<dim>    &mesh,
                 const std::string  &directory,
                 const std::uint64_t n)
    {
      const MPI_Comm          &comm    = mesh.communicator();
      const std::uint64_t      rank    = Utilities::MPI::this_mpi_process(comm);
      const std::uint64_t      n_ranks = Utilities::MPI::n_mpi_processes(comm);
      const std::uint64_t      begin   = n * rank / n_ranks, end = n * (rank + 1) / n_ranks;
      constexpr unsigned int   size    = 2 * dim;
      const auto               numbers = TableFile<double>::read(
        comm, directory + "/markers", size * begin, size * (end - begin));
      std::vector<Marker<dim>> part;
      for (std::uint64_t k = 0; k < end - begin; ++k)
        part.push_back(Marker<dim>::from(&numbers[size * k]));
      return to_owners(mesh, part);
    }
  } // namespace

  template <int dim>
  void
  Checkpoint<dim>::write(const State<dim> &state, const Progress &progress) const
  {
    const bool        is_writer = Utilities::MPI::this_mpi_process(comm) == 0;
    const std::string fresh = path + ".new", old = path + ".old";
    if (is_writer)
      discard(fresh);
    create_directory(comm, fresh);

    const Mesh<dim> &mesh = *state.mesh;
    if (mesh.is_lattice())
      TableFile<int>::write(comm, fresh + "/leaves", numbers_of_leaves(mesh.octree()));

    std::vector<double> rows;
    const unsigned int size = row_size<dim>(state.material.has_value(), velocity_before(state));
    rows.reserve(size * mesh.n_owned_cells());
    for_each_number<dim>(state,
                         [&](const Vector &v, const LocalIndex i, const LocalIndex) {
                           rows.push_back(v.local_element(i));
                         });
    if (!mesh.is_lattice()) // there owned cells stand in the order of their numbers
      rows = RowOrder<dim>(mesh, size).shares(rows);
    TableFile<double>::write(comm, fresh + "/cells", rows);
    std::vector<double> markers;
    for (const Marker<dim> &marker : state.markers)
      {
        const auto numbers = marker.numbers();
        markers.insert(markers.end(), numbers.begin(), numbers.end());
      }
    TableFile<double>::write(comm, fresh + "/markers", markers);
    const auto n_markers =
      Utilities::MPI::sum(static_cast<std::uint64_t>(state.markers.size()), comm);
    replace_file(comm, info_file(fresh), [&](std::ostream &out) {
      write_info<dim>(out, state, n_markers, progress);
    });

    std::error_code error;
    if (is_writer)
      {
        discard(old);
        if (fs::exists(path))
          fs::rename(path, old, error);
        if (!error)
          fs::rename(fresh, path, error);
        if (!error)
          discard(old);
      }
    throw_first(comm,
                error ? "The checkpoint \"" + path +
                          "\" cannot be replaced: " + error.message() + "." :
                        std::string());
  }

  template <int dim>
  std::shared_ptr<const Octree<dim>>
  Checkpoint<dim>::load_octree(
    const std::string                                    &directory,
    const typename Octree<dim>::Parameters               &parameters,
    const std::function<unsigned int(const Leaf<dim> &)> &weight) const
  {
    std::size_t n = 0;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::error_code error;
        n = fs::file_size(directory + "/leaves", error) / sizeof(int);
        if (error)
          n = 0; // the reader will complain
      }
    n = Utilities::MPI::broadcast(comm, n);
    const std::vector<int> numbers =
      TableFile<int>::read(comm, directory + "/leaves", 0, n);
    std::unordered_map<VertexKey, unsigned int> level_at; // by a leaf's lowest corner
    for (std::size_t i = 0; i + dim < n; i += dim + 1)
      {
        LatticePoint<dim> origin;
        std::copy_n(numbers.begin() + i, dim, origin.begin());
        level_at[pack<dim>(origin)] = numbers[i + dim];
      }
    return std::make_shared<const Octree<dim>>(
      comm,
      parameters,
      [&](const std::vector<Leaf<dim>> &leaves) {
        std::vector<bool> refine;
        for (const Leaf<dim> &leaf : leaves)
          {
            const auto it = level_at.find(pack<dim>(leaf.origin));
            refine.push_back(it != level_at.end() && it->second > leaf.level);
          }
        return refine;
      },
      weight);
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
    info.require_same("Format", "the format", "3");
    info.require_same("Dimension", "Dimension", std::to_string(dim));
    info.require_same("Mesh type", "Mesh/Type", mesh_type);
    return {directory, info};
  }

  template <int dim>
  std::pair<State<dim>, typename Checkpoint<dim>::Progress>
  Checkpoint<dim>::load(
    const typename Octree<dim>::Parameters               &parameters,
    const std::function<unsigned int(const Leaf<dim> &)> &weight) const
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

    const auto mesh =
      std::make_shared<const Mesh<dim>>(load_octree(directory, parameters, weight));
    require(info.get("Cells") == std::to_string(mesh->cells->size()),
            "The checkpoint \"" + directory + "\" is damaged: its leaves do not make " +
              info.get("Cells") + " cells.");
    const unsigned int n = row_size<dim>(info);
    return load_state(mesh,
                      directory,
                      info,
                      TableFile<double>::read(comm,
                                              directory + "/cells",
                                              n * mesh->cells->local_range().first,
                                              n * mesh->n_owned_cells()));
  }

  template <int dim>
  std::pair<State<dim>, typename Checkpoint<dim>::Progress>
  Checkpoint<dim>::load(std::shared_ptr<const Mesh<dim>> imported) const
  {
    const auto [directory, info] = find("file");
    const auto &[lower, upper]   = imported->box().get_boundary_points();
    info.require_same("Cells", "the number of cells of Mesh/File", std::to_string(imported->cells->size()));
    info.require_same("Nodes", "the number of vertices of Mesh/File", std::to_string(imported->nodes->size()));
    info.require_same("Lower corner", "the lower corner of Mesh/File", to_text(lower, 17));
    info.require_same("Upper corner", "the upper corner of Mesh/File", to_text(upper, 17));
    const RowOrder<dim> order(*imported, row_size<dim>(info));
    return load_state(imported,
                      directory,
                      info,
                      order.rows(TableFile<double>::read(
                        comm, directory + "/cells", order.offset(), order.n_numbers())));
  }

  template <int dim>
  std::pair<State<dim>, typename Checkpoint<dim>::Progress>
  Checkpoint<dim>::load_state(std::shared_ptr<const Mesh<dim>> mesh,
                              const std::string               &directory,
                              const CheckpointInfo            &info,
                              const std::vector<double>       &rows) const
  {
    State<dim> state(mesh);
    if (has_material(info))
      state.material = CarriedMaterial(mesh->nodes);
    if (const std::string before = info.get("Velocity before"); before != "none")
      {
        state.before.emplace();
        state.before->dt = std::stod(info.get("Step before"));
        if (before == "nodes")
          state.before->v.emplace(mesh->nodes);
        else
          state.before->u.emplace(mesh->faces);
      }
    state.time = std::stod(info.get("Time"));
    state.step = std::stoul(info.get("Step"));
    auto next  = rows.begin();
    // every owned node and face is one of an owned cell
    for_each_number<dim>(state,
                         [&](Vector &v, const LocalIndex i, const LocalIndex n_owned) {
                           if (i < n_owned)
                             v.local_element(i) = *next;
                           ++next;
                         });
    if (state.material)
      state.material->update_ghost_values();
    if (state.before && state.before->v)
      state.before->v->update_ghost_values();
    if (state.before && state.before->u)
      state.before->u->update_ghost_values();
    state.markers = load_markers<dim>(*mesh, directory, std::stoull(info.get("Markers")));
    state.phi.update_ghost_values();
    state.u.update_ghost_values();
    state.v.update_ghost_values();
    state.pressure.update_ghost_values();

    Progress progress;
    progress.frame   = std::stoul(info.get("Frame"));
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
