// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/choice.h>
#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/io/appended_data.h>
#include <treacle/io/coordinates.h>
#include <treacle/io/mesh_fields.h>
#include <treacle/io/mesh_writer.h>
#include <treacle/io/xdmf.h>

#include <deal.II/base/data_out_base.h>

#include <fstream>
#include <iomanip>
#include <regex>

namespace treacle
{
  template <int dim>
  void
  MeshWriter<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    add_choice(prm,
               "Mesh format",
               format,
               "Files of the mesh with level set (m), velocity (m/s), pressure (Pa), "
               "viscosity (Pa s), liquid fraction and rank, one set a frame.",
               {{"vtu", MeshFormat::vtu},
                {"xdmf", MeshFormat::xdmf},
                {"none", MeshFormat::none}});
    prm.leave_subsection();
  }

  namespace
  {
    /// This rank's piece. Not deal.II's DataOut: that repeats the nodes for each
    /// cell, twenty times as many points.
    template <int dim>
    void
    write_piece(std::ostream            &out,
                const State<dim>        &state,
                const LiquidDomain<dim> &domain)
    {
      const Mesh<dim>          &mesh = *state.mesh;
      std::vector<std::int32_t> index(mesh.node_position.size(), -1), connectivity,
        offsets;
      std::vector<LocalIndex> nodes;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        {
          for (const LocalIndex node : mesh.cell_nodes[c])
            {
              if (index[node] < 0)
                {
                  index[node] = nodes.size();
                  nodes.push_back(node);
                }
              connectivity.push_back(index[node]);
            }
          offsets.push_back(connectivity.size());
        }
      const std::vector<std::uint8_t> types(offsets.size(), dim == 2 ? 5 : 10); // of VTK

      AppendedData data;
      std::string  body = "<Piece NumberOfPoints=\"" + std::to_string(nodes.size()) +
                         "\" NumberOfCells=\"" + std::to_string(offsets.size()) +
                         "\">\n<PointData>\n";
      for (const Field &field : node_fields(state, nodes))
        body += data.array(field.name, field.n_components, field.values);
      body += "</PointData>\n<CellData>\n";
      for (const Field &field : cell_fields(state, domain))
        body += data.array(field.name, field.n_components, field.values);
      body += "</CellData>\n<Points>\n";
      body += as_written(positions(mesh, nodes), need_doubles(mesh), [&](const auto &x) {
        return data.array("Points", 3, x);
      });
      body += "</Points>\n<Cells>\n";
      body += data.array("connectivity", 1, connectivity);
      body += data.array("offsets", 1, offsets);
      body += data.array("types", 1, types) + "</Cells>\n</Piece>\n";
      data.write_file(out, "UnstructuredGrid", body);
    }

    void
    write_pvtu(std::ostream                   &out,
               const std::vector<Field>       &at_nodes,
               const std::vector<Field>       &in_cells,
               const bool                      in_doubles,
               const std::vector<std::string> &pieces)
    {
      const auto declare = [&](const std::string &name, const unsigned int n_components, const bool is_double = false) {
        out << "<PDataArray type=\"" << (is_double ? vtk_type<double>() : vtk_type<float>()) << "\" Name=\"" << name
            << "\" NumberOfComponents=\"" << n_components << "\"/>\n";
      };
      out
        << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
           "<PUnstructuredGrid GhostLevel=\"0\">\n<PPointData>\n";
      for (const Field &field : at_nodes)
        declare(field.name, field.n_components);
      out << "</PPointData>\n<PCellData>\n";
      for (const Field &field : in_cells)
        declare(field.name, field.n_components);
      out << "</PCellData>\n<PPoints>\n";
      declare("Points", 3, in_doubles);
      out << "</PPoints>\n";
      for (const std::string &piece : pieces)
        out << "<Piece Source=\"" << piece << "\"/>\n";
      out << "</PUnstructuredGrid>\n</VTKFile>\n";
    }

    /// mesh.pvd with this frame behind those before it that it lists already.
    void
    write_pvd(const MPI_Comm    &comm,
              const std::string &path,
              const std::string &pvtu,
              const double       time)
    {
      replace_file(comm, path, [&](std::ostream &out) {
        std::vector<std::pair<double, std::string>> records;
        const std::regex entry("timestep=\"([^\"]*)\".*file=\"([^\"]*)\"");
        std::ifstream    old(path);
        std::smatch      match;
        for (std::string line; std::getline(old, line);)
          if (std::regex_search(line, match, entry) && match[2].str() < pvtu)
            records.emplace_back(std::stod(match[1]), match[2]);
        records.emplace_back(time, pvtu);
        out << std::setprecision(15);
        DataOutBase::write_pvd_record(out, records);
      });
    }

    template <int dim>
    void
    write_vtu(const State<dim>        &state,
              const LiquidDomain<dim> &domain,
              const std::string       &directory,
              const std::string       &name)
    {
      const MPI_Comm          &comm = state.mesh->communicator();
      std::vector<std::string> pieces;
      for (unsigned int r = 0; r < Utilities::MPI::n_mpi_processes(comm); ++r)
        pieces.push_back(name + "." + Utilities::int_to_string(r, 4) + ".vtu");

      const std::string path =
        directory + "/" + pieces[Utilities::MPI::this_mpi_process(comm)];
      throw_first(comm, replace_file(path, [&](std::ostream &out) {
                    write_piece(out, state, domain);
                  }));
      replace_file(comm, directory + "/" + name + ".pvtu", [&](std::ostream &out) {
        write_pvtu(out, node_fields(state, {}), cell_fields(state, domain), need_doubles(*state.mesh), pieces);
      });
      write_pvd(comm, directory + "/mesh.pvd", name + ".pvtu", state.time);
    }
  } // namespace

  template <int dim>
  void
  MeshWriter<dim>::write(const State<dim>        &state,
                         const LiquidDomain<dim> &domain,
                         const std::string       &directory,
                         const unsigned int       frame) const
  {
    if (format == MeshFormat::none)
      return;
    const std::string frames = directory + "/frames";
    create_directory(state.mesh->communicator(), frames);
    const std::string name = "mesh_" + Utilities::int_to_string(frame, 5);
    if (format == MeshFormat::vtu)
      write_vtu(state, domain, frames, name);
    else
      write_xdmf(state, domain, frames, name);
  }

  template class MeshWriter<2>;
  template class MeshWriter<3>;
} // namespace treacle
