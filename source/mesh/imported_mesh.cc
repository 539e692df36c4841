// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/geometry/simplex.h>
#include <treacle/mesh/dual_weights.h>
#include <treacle/mesh/ghost_cells.h>
#include <treacle/mesh/imported_mesh.h>
#include <treacle/mesh/mesh_file.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    /// A cell as ranks exchange it.
    template <int dim>
    struct Record
    {
      GlobalIndex                                  id, number;
      unsigned int                                 owner;
      double                                       size;
      std::array<VertexKey, dim + 1>               vertex;
      std::array<std::array<double, dim>, dim + 1> position;
      VertexValues<dim>                            weight;
      std::array<unsigned short, dim + 1>          vertex_walls;
      std::array<unsigned char, dim + 1>           wall;
    };

    /// Edge of the leaf on which cells of a uniform lattice have this volume.
    template <int dim>
    double
    lattice_size(const double volume)
    {
      return dim == 2 ? std::sqrt(4 * volume) : std::cbrt(12 * volume);
    }

    /// Cells rank by rank, and those of a rank along a space filling curve.
    template <int dim>
    std::vector<unsigned int>
    order_of(const MeshFile<dim> &file)
    {
      std::vector<Point<dim>> centres;
      for (const auto &cell : file.cells)
        {
          centres.emplace_back();
          for (const unsigned int v : cell)
            centres.back() += file.vertices[v] / (dim + 1);
        }
      const auto place = Utilities::inverse_Hilbert_space_filling_curve<dim>(centres, 20);
      std::vector<unsigned int> order(file.cells.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(),
                order.end(),
                [&](const unsigned int a, const unsigned int b) {
                  return std::tie(file.rank_of[a], place[a], a) <
                         std::tie(file.rank_of[b], place[b], b);
                });
      return order;
    }

    template <int dim>
    Simplex<dim>
    vertices_of(const MeshFile<dim> &file, const unsigned int cell)
    {
      Simplex<dim> x;
      for (unsigned int v = 0; v <= dim; ++v)
        x[v] = file.vertices[file.cells[cell][v]];
      return x;
    }

    template <int dim>
    PerRank<Record<dim>>
    make_records(const MeshFile<dim>       &file,
                 const std::vector<double> &sizes,
                 const unsigned int         n_ranks)
    {
      PerRank<Record<dim>>      result(n_ranks);
      const std::vector<double> weights = dual_weights(file);
      GlobalIndex               id      = 0;
      for (const unsigned int c : order_of(file))
        {
          Record<dim> record;
          record.id     = id++;
          record.number = c;
          record.owner  = file.rank_of[c];
          record.size   = sizes[c];
          record.wall   = file.walls[c];
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const unsigned int vertex = file.cells[c][v];
              record.vertex[v]          = vertex;
              record.vertex_walls[v]    = file.vertex_walls[vertex];
              record.weight[v]          = weights[vertex];
              for (unsigned int d = 0; d < dim; ++d)
                record.position[v][d] = file.vertices[vertex][d];
            }
          result[record.owner].push_back(record);
        }
      return result;
    }

    template <int dim>
    MeshCells<dim>
    mesh_cells(const std::vector<Record<dim>> &records)
    {
      MeshCells<dim>                              result;
      std::unordered_map<VertexKey, unsigned int> vertex_index;
      for (const Record<dim> &record : records)
        {
          typename MeshCells<dim>::Cell cell{
            record.id, record.number, record.owner, record.size, {}, record.wall};
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const auto [it, is_new] =
                vertex_index.emplace(record.vertex[v], result.vertices.size());
              if (is_new)
                {
                  Point<dim> x;
                  for (unsigned int d = 0; d < dim; ++d)
                    x[d] = record.position[v][d];
                  result.vertices.push_back(
                    {record.vertex[v], x, record.weight[v], record.vertex_walls[v]});
                }
              cell.vertex[v] = it->second;
            }
          result.cells.push_back(cell);
        }
      return result;
    }
  } // namespace

  template <int dim>
  void
  ImportedMesh<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    add_choice(
      prm,
      "Type",
      type,
      "\"lattice\": made for the liquid from an octree on the box, and made again "
      "when it moves; \"file\": read from a file once, box and levels are not "
      "used.",
      {{"lattice", MeshType::lattice}, {"file", MeshType::file}});
    prm.add_parameter(
      "File",
      file,
      "Mesh of triangles (2D) or tetrahedra (3D) for the type \"file\", lengths in "
      "m: Gmsh's .msh, version 2 or 4 in ASCII, or another format that deal.II "
      "reads and knows by the name's ending.",
      Patterns::FileName());
    prm.leave_subsection();
  }

  namespace
  {
    /// The cells of each rank, as rank 0 reads them, which tells their sizes.
    template <int dim>
    PerRank<Record<dim>>
    read_records(const std::string &path,
                 const unsigned int n_ranks,
                 double            &largest_size,
                 double            &mean_size)
    {
      const MeshFile<dim> file(path, n_ranks);
      std::vector<double> sizes; // in the order of the file
      for (unsigned int c = 0; c < file.cells.size(); ++c)
        sizes.push_back(lattice_size<dim>(signed_volume<dim>(vertices_of(file, c))));
      largest_size = *std::max_element(sizes.begin(), sizes.end());
      mean_size    = std::accumulate(sizes.begin(), sizes.end(), 0.) / sizes.size();
      return make_records(file, sizes, n_ranks);
    }

    /// The cells of this rank. Collective.
    template <int dim>
    std::vector<Record<dim>>
    receive_records(const MPI_Comm    &comm,
                    const std::string &path,
                    double            &largest_size,
                    double            &mean_size)
    {
      const unsigned int   n_ranks = Utilities::MPI::n_mpi_processes(comm);
      PerRank<Record<dim>> from_file(n_ranks);
      std::string          error;
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        keep_error(error, [&] {
          from_file = read_records<dim>(path, n_ranks, largest_size, mean_size);
        });
      throw_first(comm, error);
      largest_size = Utilities::MPI::broadcast(comm, largest_size);
      mean_size    = Utilities::MPI::broadcast(comm, mean_size);
      return send_and_receive(comm, from_file)[0];
    }
  } // namespace

  template <int dim>
  ImportedMesh<dim>::ImportedMesh(const MPI_Comm &comm, const std::string &path)
  {
    std::vector<Record<dim>> records =
      receive_records<dim>(comm, path, largest_size, mean_size);
    std::unordered_set<VertexKey> vertices;
    for (const Record<dim> &record : records)
      vertices.insert(record.vertex.begin(), record.vertex.end());
    exchange_ghosts(comm, vertices, records);
    cells = mesh_cells(records);
  }

  template struct ImportedMesh<2>;
  template struct ImportedMesh<3>;
} // namespace treacle
