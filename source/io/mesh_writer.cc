// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/io/appended_data.h>
#include <treacle/io/mesh_writer.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/hdf5.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <regex>
#include <sstream>

namespace treacle
{
  template <int dim>
  void
  MeshWriter<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter("Mesh format",
                      format,
                      "Files of the mesh with level set (m), velocity (m/s), pressure (Pa), "
                      "viscosity (Pa s), liquid fraction and rank, one set a frame.",
                      Patterns::Selection("vtu|xdmf|none"));
    prm.leave_subsection();
  }

  namespace
  {
    /// One array at the nodes or in the cells, component by component.
    struct Field
    {
      std::string        name;
      unsigned int       n_components;
      std::vector<float> values;
    };

    template <int dim>
    std::vector<Field>
    node_fields(const State<dim> &state, const std::vector<LocalIndex> &nodes)
    {
      Field phi{"phi", 1, {}}, velocity{"velocity", 3, {}};
      for (const LocalIndex node : nodes)
        {
          phi.values.push_back(state.phi.local_element(node));
          for (unsigned int d = 0; d < 3; ++d)
            velocity.values.push_back(d < dim ? state.v.component[d].local_element(node) : 0);
        }
      return {phi, velocity};
    }

    template <int dim>
    std::vector<Field>
    cell_fields(const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      const Mesh<dim> &mesh = *state.mesh;
      const float      rank = Utilities::MPI::this_mpi_process(mesh.communicator());
      std::vector<Field> fields{{"pressure", 1, {}}, {"viscosity", 1, {}}, {"liquid_fraction", 1, {}}, {"rank", 1, {}}};
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        {
          fields[0].values.push_back(state.pressure.local_element(c));
          fields[1].values.push_back(domain.viscosity[c]);
          fields[2].values.push_back(domain.liquid_volume[c] / mesh.cell_volume[c]);
          fields[3].values.push_back(rank);
        }
      return fields;
    }

    template <int dim>
    std::vector<float>
    positions(const Mesh<dim> &mesh, const std::vector<LocalIndex> &nodes)
    {
      std::vector<float> x;
      x.reserve(3 * nodes.size());
      for (const LocalIndex node : nodes)
        for (unsigned int d = 0; d < 3; ++d)
          x.push_back(d < dim ? mesh.node_position[node][d] : 0);
      return x;
    }

    // -- VTU --

    /// This rank's piece. Not deal.II's DataOut: that repeats the nodes for each
    /// cell, twenty times as many points.
    template <int dim>
    void
    write_piece(std::ostream &out, const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      const Mesh<dim>          &mesh = *state.mesh;
      std::vector<std::int32_t> index(mesh.node_position.size(), -1), connectivity, offsets;
      std::vector<LocalIndex>   nodes;
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
      body += "</CellData>\n<Points>\n" + data.array("Points", 3, positions(mesh, nodes)) +
              "</Points>\n<Cells>\n";
      body += data.array("connectivity", 1, connectivity);
      body += data.array("offsets", 1, offsets);
      body += data.array("types", 1, types) + "</Cells>\n</Piece>\n";
      data.write_file(out, "UnstructuredGrid", body);
    }

    void
    write_pvtu(std::ostream             &out,
               const std::vector<Field> &at_nodes,
               const std::vector<Field> &in_cells,
               const std::vector<std::string> &pieces)
    {
      const auto declare = [&](const std::string &name, const unsigned int n_components) {
        out << "<PDataArray type=\"Float32\" Name=\"" << name << "\" NumberOfComponents=\""
            << n_components << "\"/>\n";
      };
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
             "<PUnstructuredGrid GhostLevel=\"0\">\n<PPointData>\n";
      for (const Field &field : at_nodes)
        declare(field.name, field.n_components);
      out << "</PPointData>\n<PCellData>\n";
      for (const Field &field : in_cells)
        declare(field.name, field.n_components);
      out << "</PCellData>\n<PPoints>\n";
      declare("Points", 3);
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
      std::vector<std::pair<double, std::string>> records;
      const std::regex entry("timestep=\"([^\"]*)\".*file=\"([^\"]*)\"");
      std::ifstream    old(path);
      std::smatch      match;
      for (std::string line; std::getline(old, line);)
        if (std::regex_search(line, match, entry) && match[2].str() < pvtu)
          records.emplace_back(std::stod(match[1]), match[2]);
      old.close();
      records.emplace_back(time, pvtu);
      replace_file(comm, path, [&](std::ostream &out) {
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
        write_pvtu(out, node_fields(state, {}), cell_fields(state, domain), pieces);
      });
      write_pvd(comm, directory + "/mesh.pvd", name + ".pvtu", state.time);
    }

    // -- HDF5 and XDMF --

    /// A table with a row for each owned entry of a partitioner, all ranks together.
    template <typename T>
    void
    write_table(HDF5::File                          &file,
                const std::string                   &name,
                const Utilities::MPI::Partitioner   &rows,
                const unsigned int                   n_columns,
                const std::vector<T>                &values)
    {
      auto set = file.create_dataset<T>(name, {rows.size(), n_columns});
      if (values.empty())
        set.template write_none<T>();
      else
        set.write_hyperslab(values,
                            {rows.local_range().first, 0},
                            {rows.locally_owned_size(), n_columns});
    }

    template <int dim>
    void
    write_hdf5(const std::string &path, const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      const Mesh<dim>        &mesh = *state.mesh;
      std::vector<LocalIndex> nodes(mesh.n_owned_nodes());
      std::iota(nodes.begin(), nodes.end(), 0);
      std::vector<int> cells;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        for (const LocalIndex node : mesh.cell_nodes[c])
          cells.push_back(mesh.nodes->local_to_global(node));

      HDF5::File file(path, HDF5::File::FileAccessMode::create, mesh.communicator());
      write_table(file, "positions", *mesh.nodes, 3, positions(mesh, nodes));
      write_table(file, "cells", *mesh.cells, dim + 1, cells);
      for (const Field &field : node_fields(state, nodes))
        write_table(file, field.name, *mesh.nodes, field.n_components, field.values);
      for (const Field &field : cell_fields(state, domain))
        write_table(file, field.name, *mesh.cells, field.n_components, field.values);
    }

    template <int dim>
    std::string
    xdmf_grid(const State<dim> &state, const LiquidDomain<dim> &domain, const std::string &name)
    {
      const Mesh<dim>   &mesh = *state.mesh;
      std::ostringstream out;
      const auto item = [&](const std::string &array, const auto n, const unsigned int k, const char *type) {
        out << "<DataItem Dimensions=\"" << n << ' ' << k << "\" NumberType=\"" << type
            << "\" Precision=\"4\" Format=\"HDF\">" << name << ".h5:/" << array << "</DataItem>";
      };
      const auto attribute = [&](const Field &field, const char *where, const auto n) {
        out << "<Attribute Name=\"" << field.name << "\" AttributeType=\""
            << (field.n_components == 1 ? "Scalar" : "Vector") << "\" Center=\"" << where
            << "\">";
        item(field.name, n, field.n_components, "Float");
        out << "</Attribute>\n";
      };
      out << "<Grid Name=\"" << name << "\">\n<Time Value=\"" << std::setprecision(15) << state.time
          << "\"/>\n<Geometry GeometryType=\"XYZ\">";
      item("positions", mesh.nodes->size(), 3, "Float");
      out << "</Geometry>\n<Topology TopologyType=\"" << (dim == 2 ? "Triangle" : "Tetrahedron")
          << "\" NumberOfElements=\"" << mesh.cells->size() << "\">";
      item("cells", mesh.cells->size(), dim + 1, "Int");
      out << "</Topology>\n";
      for (const Field &field : node_fields(state, {}))
        attribute(field, "Node", mesh.nodes->size());
      for (const Field &field : cell_fields(state, domain))
        attribute(field, "Cell", mesh.cells->size());
      out << "</Grid>\n";
      return out.str();
    }

    /// The entries of an older list that come before the frame of this name.
    std::string
    earlier_grids(const std::string &path, const std::string &name)
    {
      std::string      result;
      bool             is_earlier = false;
      const std::regex begin("<Grid Name=\"(mesh_[0-9]+)\">");
      std::ifstream    file(path);
      std::smatch      match;
      for (std::string line; std::getline(file, line);)
        {
          if (std::regex_search(line, match, begin))
            is_earlier = match[1].str() < name;
          if (is_earlier)
            result += line + '\n';
          is_earlier = is_earlier && line != "</Grid>";
        }
      return result;
    }

    template <int dim>
    void
    write_xdmf(const State<dim>        &state,
               const LiquidDomain<dim> &domain,
               const std::string       &directory,
               const std::string       &name)
    {
      const MPI_Comm   &comm = state.mesh->communicator();
      const std::string h5   = directory + "/" + name + ".h5";
      write_hdf5(h5 + ".new", state, domain);
      MPI_Barrier(comm);
      std::error_code error;
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        std::filesystem::rename(h5 + ".new", h5, error);
      throw_first(comm,
                  error ? "The file \"" + h5 + "\" cannot be written: " + error.message() + "." :
                          std::string());

      const std::string path  = directory + "/mesh.xdmf";
      const std::string grids = earlier_grids(path, name) + xdmf_grid(state, domain, name);
      replace_file(comm, path, [&](std::ostream &out) {
        out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
               "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
            << grids << "</Grid>\n</Domain>\n</Xdmf>\n";
      });
    }
  } // namespace

  template <int dim>
  void
  MeshWriter<dim>::write(const State<dim>        &state,
                         const LiquidDomain<dim> &domain,
                         const std::string       &directory,
                         const unsigned int       frame) const
  {
    if (format == "none")
      return;
    const std::string frames = directory + "/frames";
    create_directory(state.mesh->communicator(), frames);
    const std::string name = "mesh_" + Utilities::int_to_string(frame, 5);
    if (format == "vtu")
      write_vtu(state, domain, frames, name);
    else
      write_xdmf(state, domain, frames, name);
  }

  template class MeshWriter<2>;
  template class MeshWriter<3>;
} // namespace treacle
