// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/io/coordinates.h>
#include <treacle/io/mesh_fields.h>
#include <treacle/io/xdmf.h>

#include <deal.II/base/hdf5.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numeric>
#include <regex>
#include <sstream>

namespace treacle
{
  namespace
  {
    /// A table with a row for each owned entry of a partitioner, all ranks together.
    template <typename T>
    void
    write_table(HDF5::File                        &file,
                const std::string                 &name,
                const Utilities::MPI::Partitioner &rows,
                const unsigned int                 n_columns,
                const std::vector<T>              &values)
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
    write_hdf5(const std::string       &path,
               const State<dim>        &state,
               const LiquidDomain<dim> &domain)
    {
      const Mesh<dim>        &mesh = *state.mesh;
      std::vector<LocalIndex> nodes(mesh.n_owned_nodes());
      std::iota(nodes.begin(), nodes.end(), 0);
      std::vector<int> cells;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        for (const LocalIndex node : mesh.cell_nodes[c])
          cells.push_back(mesh.nodes->local_to_global(node));

      HDF5::File file(path, HDF5::File::FileAccessMode::create, mesh.communicator());
      as_written(positions(mesh, nodes), need_doubles(mesh), [&](const auto &x) {
        write_table(file, "positions", *mesh.nodes, 3, x);
      });
      write_table(file, "cells", *mesh.cells, dim + 1, cells);
      for (const Field &field : node_fields(state, nodes))
        write_table(file, field.name, *mesh.nodes, field.n_components, field.values);
      for (const Field &field : cell_fields(state, domain))
        write_table(file, field.name, *mesh.cells, field.n_components, field.values);
    }

    template <int dim>
    std::string
    xdmf_grid(const State<dim>        &state,
              const LiquidDomain<dim> &domain,
              const std::string       &name)
    {
      const Mesh<dim>   &mesh = *state.mesh;
      std::ostringstream out;
      const auto         item = [&](const std::string &array,
                            const auto         n,
                            const unsigned int k,
                            const char        *type,
                            const unsigned int bytes = 4) {
        out << "<DataItem Dimensions=\"" << n << ' ' << k << "\" NumberType=\"" << type
            << "\" Precision=\"" << bytes << "\" Format=\"HDF\">" << name << ".h5:/" << array
            << "</DataItem>";
      };
      const auto attribute = [&](const Field &field, const char *where, const auto n) {
        out << "<Attribute Name=\"" << field.name << "\" AttributeType=\""
            << (field.n_components == 1 ? "Scalar" : "Vector") << "\" Center=\"" << where
            << "\">";
        item(field.name, n, field.n_components, "Float");
        out << "</Attribute>\n";
      };
      out << "<Grid Name=\"" << name << "\">\n<Time Value=\"" << std::setprecision(15)
          << state.time << "\"/>\n<Geometry GeometryType=\"XYZ\">";
      item("positions", mesh.nodes->size(), 3, "Float", need_doubles(mesh) ? 8 : 4);
      out << "</Geometry>\n<Topology TopologyType=\""
          << (dim == 2 ? "Triangle" : "Tetrahedron") << "\" NumberOfElements=\""
          << mesh.cells->size() << "\">";
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
  } // namespace

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
                error ?
                  "The file \"" + h5 + "\" cannot be written: " + error.message() + "." :
                  std::string());

    const std::string path  = directory + "/mesh.xdmf";
    const std::string grid = xdmf_grid(state, domain, name);
    replace_file(comm, path, [&](std::ostream &out) {
      out
        << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
           "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
        << earlier_grids(path, name) << grid << "</Grid>\n</Domain>\n</Xdmf>\n";
    });
  }

  template void
  write_xdmf(const State<2> &,
             const LiquidDomain<2> &,
             const std::string &,
             const std::string &);
  template void
  write_xdmf(const State<3> &,
             const LiquidDomain<3> &,
             const std::string &,
             const std::string &);
} // namespace treacle
