// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/files.h>
#include <treacle/io/appended_data.h>
#include <treacle/io/coordinates.h>
#include <treacle/io/liquid_surface.h>
#include <treacle/io/surface_writer.h>

#include <iomanip>

namespace treacle
{
  namespace
  {
    /// The names are the endings of the files too.
    const Choice<SurfaceFormat> &
    surface_formats()
    {
      static const Choice<SurfaceFormat> formats{{"ply", SurfaceFormat::ply},
                                                 {"obj", SurfaceFormat::obj},
                                                 {"vtp", SurfaceFormat::vtp},
                                                 {"none", SurfaceFormat::none}};
      return formats;
    }
  } // namespace

  template <int dim>
  void
  SurfaceWriter<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    add_choice(prm,
               "Surface format",
               format,
               "Files of the surface with its velocity (m, m/s), one a frame.",
               surface_formats());
    prm.leave_subsection();
  }

  namespace
  {
    /// To a binary file.
    template <typename Numbers>
    void
    write_numbers(std::ostream &out, const Numbers &numbers)
    {
      out.write(reinterpret_cast<const char *>(numbers.data()), numbers.size() * sizeof numbers[0]);
    }

    template <int dim>
    void
    write_ply(std::ostream &out, const LiquidSurface<dim> &surface)
    {
      out << "ply\nformat binary_little_endian 1.0\ncomment Treacle\nelement vertex "
          << surface.vertices.size() << '\n';
      for (const char *name : {"x", "y", "z"})
        out << "property " << (surface.in_doubles ? "double " : "float ") << name << '\n';
      for (const char *name : {"vx", "vy", "vz"})
        out << "property float " << name << '\n';
      if (dim == 2)
        out << "element edge " << surface.facets.size()
            << "\nproperty int vertex1\nproperty int vertex2\n";
      else
        out << "element face " << surface.facets.size()
            << "\nproperty list uchar int vertex_indices\n";
      out << "end_header\n";
      for (const auto &vertex : surface.vertices)
        {
          as_written(vertex.position, surface.in_doubles, [&](const auto &x) { write_numbers(out, x); });
          write_numbers(out, vertex.velocity);
        }
      for (const auto &facet : surface.facets)
        {
          if (dim == 3)
            out.put(dim);
          write_numbers(out, facet);
        }
    }

    template <int dim>
    void
    write_obj(std::ostream &out, const LiquidSurface<dim> &surface)
    {
      out << std::setprecision(surface.in_doubles ? 17 : 9); // all of a double or a float
      for (const auto &vertex : surface.vertices)
        as_written(vertex.position, surface.in_doubles, [&](const auto &x) {
          out << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
        });
      for (const auto &facet : surface.facets)
        {
          out << (dim == 2 ? 'l' : 'f');
          for (const auto i : facet)
            out << ' ' << i + 1;
          out << '\n';
        }
    }

    template <int dim>
    void
    write_vtp(std::ostream &out, const LiquidSurface<dim> &surface)
    {
      std::vector<double>       points;
      std::vector<float>        velocity;
      std::vector<std::int32_t> connectivity, offsets;
      for (const auto &vertex : surface.vertices)
        {
          points.insert(points.end(), vertex.position.begin(), vertex.position.end());
          velocity.insert(velocity.end(), vertex.velocity.begin(), vertex.velocity.end());
        }
      for (const auto &facet : surface.facets)
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
              "</PointData>\n<Points>\n";
      body += as_written(points, surface.in_doubles, [&](const auto &x) { return data.array("Points", 3, x); });
      body += "</Points>\n";
      body += "<" + element + ">\n" + data.array("connectivity", 1, connectivity);
      body += data.array("offsets", 1, offsets) + "</" + element + ">\n</Piece>\n";
      data.write_file(out, "PolyData", body);
    }
  } // namespace

  template <int dim>
  void
  SurfaceWriter<dim>::write(const State<dim>        &state,
                            const LiquidDomain<dim> &domain,
                            const std::string       &directory,
                            const unsigned int       frame) const
  {
    if (format == SurfaceFormat::none)
      return;
    const MPI_Comm &comm = state.mesh->communicator();
    create_directory(comm, directory + "/frames");
    const LiquidSurface<dim> surface = gather_liquid_surface(state, domain);
    const std::string        path    = directory + "/frames/surface_" +
                             Utilities::int_to_string(frame, 5) + "." +
                             surface_formats().name(format);
    replace_file(comm, path, [&](std::ostream &out) {
      if (format == SurfaceFormat::ply)
        write_ply(out, surface);
      else if (format == SurfaceFormat::obj)
        write_obj(out, surface);
      else
        write_vtp(out, surface);
    });
  }

  template class SurfaceWriter<2>;
  template class SurfaceWriter<3>;
} // namespace treacle
