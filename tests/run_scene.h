// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_run_scene_h
#define treacle_tests_run_scene_h

#include <treacle/simulator.h>

#include <fstream>
#include <map>
#include <sstream>

namespace tests
{
  using namespace treacle;

  using Row = std::map<std::string, double>;

  /// The rows of a statistics file by the names of its columns.
  inline std::vector<Row>
  read_statistics(const std::string &path)
  {
    std::ifstream            file(path);
    std::vector<std::string> names;
    std::vector<Row>         rows;
    for (std::string line; std::getline(file, line);)
      if (line[0] == '#')
        names.push_back(line.substr(line.find(": ") + 2));
      else
        {
          std::istringstream values(line);
          rows.emplace_back();
          for (const std::string &name : names)
            values >> rows.back()[name];
        }
    return rows;
  }

  inline double
  energy(const Row &row)
  {
    return row.at("Potential energy (J)") + row.at("Kinetic energy (J)");
  }

  template <int dim>
  typename Simulator<dim>::Parameters
  parse(const std::string &text,
        const unsigned int n_solids,
        const unsigned int n_liquids  = 1,
        const unsigned int n_emitters = 0,
        const unsigned int n_probes   = 0)
  {
    ParameterHandler                    prm;
    typename Simulator<dim>::Parameters parameters;
    parameters.add_parameters(prm, n_liquids, n_solids, n_emitters, n_probes);
    prm.parse_input_from_string(text);
    return parameters;
  }

  /// Where run_scene() writes.
  inline std::string
  run_directory(const MPI_Comm &comm, const int dim)
  {
    return "run_" + std::to_string(dim) + "d_" + std::to_string(Utilities::MPI::n_mpi_processes(comm));
  }

  /// Does the log of the last run_scene() say this?
  inline bool
  has_logged(const MPI_Comm &comm, const int dim, const std::string &words)
  {
    std::ifstream     file(run_directory(comm, dim) + "/log.txt");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.find(words) != std::string::npos;
  }

  /// Run the scene of a parameter text and return its statistics. Collective.
  template <int dim>
  std::vector<Row>
  run_scene(const MPI_Comm    &comm,
            const std::string &text,
            const unsigned int n_solids   = 0,
            const unsigned int n_liquids  = 1,
            const unsigned int n_emitters = 0,
            const unsigned int n_probes   = 0)
  {
    typename Simulator<dim>::Parameters parameters =
      parse<dim>(text, n_solids, n_liquids, n_emitters, n_probes);
    parameters.output_directory      = run_directory(comm, dim);
    parameters.mesh_writer.format    = MeshFormat::none;
    parameters.surface_writer.format = SurfaceFormat::none;
    parameters.checkpoint.interval   = 0;
    Simulator<dim>(comm, parameters, "").run(false);
    MPI_Barrier(comm);
    return read_statistics(parameters.output_directory + "/statistics");
  }

  /// The subsection of tight tolerances.
  inline std::string
  tolerance(const std::string &value)
  {
    std::string text = "subsection Linear solvers\n";
    for (const std::string name : {"Pressure", "Viscosity", "Face fit", "Coupled"})
      text += "subsection " + name + "\nset Relative tolerance = " + value + "\nend\n";
    return text + "end\n";
  }
} // namespace tests

#endif
