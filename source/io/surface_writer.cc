// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/files.h>
#include <treacle/io/appended_data.h>
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
    template <int dim>
    void
    write_ply(std::ostream &out, const LiquidSurface<dim> &surface)
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
      for (const auto &vertex : surface.vertices)
        out.write(reinterpret_cast<const char *>(vertex.values.data()),
                  sizeof vertex.values);
      for (const auto &facet : surface.facets)
        {
          if (dim == 3)
            out.put(dim);
          out.write(reinterpret_cast<const char *>(facet.data()), sizeof facet);
        }
    }

    template <int dim>
    void
    write_obj(std::ostream &out, const LiquidSurface<dim> &surface)
    {
      out << std::setprecision(9); // all of a float
      for (const auto &vertex : surface.vertices)
        out << "v " << vertex.values[0] << ' ' << vertex.values[1] << ' '
            << vertex.values[2] << '\n';
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
      std::vector<float>        points, velocity;
      std::vector<std::int32_t> connectivity, offsets;
      for (const auto &vertex : surface.vertices)
        {
          points.insert(points.end(), vertex.values.begin(), vertex.values.begin() + 3);
          velocity.insert(velocity.end(), vertex.values.begin() + 3, vertex.values.end());
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
              "</PointData>\n<Points>\n" + data.array("Points", 3, points) +
              "</Points>\n";
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
