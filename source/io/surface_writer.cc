// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/fields/surface.h>
#include <treacle/io/appended_data.h>
#include <treacle/io/surface_writer.h>

#include <iomanip>

namespace treacle
{
  template <int dim>
  void
  SurfaceWriter<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter("Surface format",
                      format,
                      "Files of the surface with its velocity (m, m/s), one a frame.",
                      Patterns::Selection("ply|obj|vtp|none"));
    prm.leave_subsection();
  }

  namespace
  {
    /// A vertex of the surface, known to all ranks by the keys of its edge.
    struct Vertex
    {
      VertexKey            a, b;
      std::array<float, 6> values; ///< position, velocity; z = 0 in 2D

      bool
      operator<(const Vertex &other) const
      {
        return std::tie(a, b) < std::tie(other.a, other.b);
      }
    };

    template <int dim>
    using Facet = std::array<std::int32_t, dim>;

    template <int dim>
    struct Gathered
    {
      std::vector<Vertex>     vertices;
      std::vector<Facet<dim>> facets;
    };

    template <int dim>
    std::vector<Vertex>
    make_vertices(const State<dim> &state, const Surface<dim> &surface)
    {
      std::vector<Vertex> vertices;
      vertices.reserve(surface.vertices.size());
      for (unsigned int i = 0; i < surface.vertices.size(); ++i)
        {
          const auto &[a, b, t] = surface.vertices[i];
          const Tensor<1, dim> velocity =
            (1 - t) * state.v.value(a) + t * state.v.value(b);
          Vertex vertex{state.mesh->node_key[a], state.mesh->node_key[b], {}};
          for (unsigned int d = 0; d < dim; ++d)
            {
              vertex.values[d]     = surface.positions[i][d];
              vertex.values[3 + d] = velocity[d];
            }
          vertices.push_back(vertex);
        }
      return vertices;
    }

    /// The whole surface on rank 0, vertices of several ranks welded and in the
    /// order of their keys. Facets are in the order of the cells, for each rank
    /// has a range of those.
    template <int dim>
    Gathered<dim>
    gather(const State<dim> &state)
    {
      const MPI_Comm    &comm    = state.mesh->communicator();
      const Surface<dim> surface = extract_surface(*state.mesh, state.phi);
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);

      PerRank<Vertex>     vertices(n_ranks);
      PerRank<Facet<dim>> facets(n_ranks);
      vertices[0] = make_vertices(state, surface);
      for (const auto &facet : surface.facets)
        {
          facets[0].emplace_back();
          std::copy(facet.begin(), facet.end(), facets[0].back().begin());
        }
      vertices = send_and_receive(comm, vertices);
      facets   = send_and_receive(comm, facets);

      Gathered<dim> result;
      for (const auto &of_rank : vertices)
        result.vertices.insert(result.vertices.end(), of_rank.begin(), of_rank.end());
      std::sort(result.vertices.begin(), result.vertices.end());
      const auto is_same = [](const Vertex &p, const Vertex &q) {
        return !(p < q) && !(q < p);
      };
      result.vertices.erase(std::unique(result.vertices.begin(),
                                        result.vertices.end(),
                                        is_same),
                            result.vertices.end());
      for (unsigned int r = 0; r < n_ranks; ++r)
        {
          std::vector<std::int32_t> index;
          for (const Vertex &vertex : vertices[r])
            index.push_back(
              std::lower_bound(result.vertices.begin(), result.vertices.end(), vertex) -
              result.vertices.begin());
          for (Facet<dim> facet : facets[r])
            {
              for (auto &i : facet)
                i = index[i];
              result.facets.push_back(facet);
            }
        }
      return result;
    }

    template <int dim>
    void
    write_ply(std::ostream &out, const Gathered<dim> &surface)
    {
      out << "ply\nformat binary_little_endian 1.0\ncomment Treacle\nelement vertex "
          << surface.vertices.size() << '\n';
      for (const char *name : {"x", "y", "z", "vx", "vy", "vz"})
        out << "property float " << name << '\n';
      if (dim == 2)
        out << "element edge " << surface.facets.size()
            << "\nproperty int vertex1\nproperty int vertex2\n";
      else
        out << "element face " << surface.facets.size()
            << "\nproperty list uchar int vertex_indices\n";
      out << "end_header\n";
      for (const Vertex &vertex : surface.vertices)
        out.write(reinterpret_cast<const char *>(vertex.values.data()),
                  sizeof vertex.values);
      for (const Facet<dim> &facet : surface.facets)
        {
          if (dim == 3)
            out.put(dim);
          out.write(reinterpret_cast<const char *>(facet.data()), sizeof facet);
        }
    }

    template <int dim>
    void
    write_obj(std::ostream &out, const Gathered<dim> &surface)
    {
      out << std::setprecision(9); // all of a float
      for (const Vertex &vertex : surface.vertices)
        out << "v " << vertex.values[0] << ' ' << vertex.values[1] << ' '
            << vertex.values[2] << '\n';
      for (const Facet<dim> &facet : surface.facets)
        {
          out << (dim == 2 ? 'l' : 'f');
          for (const auto i : facet)
            out << ' ' << i + 1;
          out << '\n';
        }
    }

    template <int dim>
    void
    write_vtp(std::ostream &out, const Gathered<dim> &surface)
    {
      std::vector<float>        points, velocity;
      std::vector<std::int32_t> connectivity, offsets;
      for (const Vertex &vertex : surface.vertices)
        {
          points.insert(points.end(), vertex.values.begin(), vertex.values.begin() + 3);
          velocity.insert(velocity.end(), vertex.values.begin() + 3, vertex.values.end());
        }
      for (const Facet<dim> &facet : surface.facets)
        {
          connectivity.insert(connectivity.end(), facet.begin(), facet.end());
          offsets.push_back(connectivity.size());
        }
      const std::string element = dim == 2 ? "Lines" : "Polys";
      AppendedData      data;
      std::string       body =
        "<Piece NumberOfPoints=\"" + std::to_string(surface.vertices.size()) +
        "\" NumberOf" + element + "=\"" + std::to_string(surface.facets.size()) + "\">\n";
      body += "<PointData Vectors=\"velocity\">\n" + data.array("velocity", 3, velocity) +
              "</PointData>\n<Points>\n" + data.array("Points", 3, points) +
              "</Points>\n";
      body += "<" + element + ">\n" + data.array("connectivity", 1, connectivity);
      body += data.array("offsets", 1, offsets) + "</" + element + ">\n</Piece>\n";
      data.write_file(out, "PolyData", body);
    }
  } // namespace

  template <int dim>
  void
  SurfaceWriter<dim>::write(const State<dim>  &state,
                            const std::string &directory,
                            const unsigned int frame) const
  {
    if (format == "none")
      return;
    const MPI_Comm &comm = state.mesh->communicator();
    create_directory(comm, directory + "/frames");
    const Gathered<dim> surface = gather(state);
    const std::string   path =
      directory + "/frames/surface_" + Utilities::int_to_string(frame, 5) + "." + format;
    replace_file(comm, path, [&](std::ostream &out) {
      if (format == "ply")
        write_ply(out, surface);
      else if (format == "obj")
        write_obj(out, surface);
      else
        write_vtp(out, surface);
    });
  }

  template class SurfaceWriter<2>;
  template class SurfaceWriter<3>;
} // namespace treacle
