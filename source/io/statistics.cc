// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/base/files.h>
#include <treacle/dynamics/measures.h>
#include <treacle/io/statistics.h>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace treacle
{
  namespace
  {
    constexpr unsigned int width = 20;

    template <int dim>
    std::string
    volume_name()
    {
      return dim == 2 ? "Liquid volume (m^2)" : "Liquid volume (m^3)";
    }

    template <int dim>
    std::string
    emitted_name()
    {
      return dim == 2 ? "Emitted volume (m^2)" : "Emitted volume (m^3)";
    }

    /// As the table shows it: a resumed run knows the first volume from there.
    double
    rounded(const double value)
    {
      char text[64];
      std::snprintf(text, sizeof text, "%.11e", value);
      return std::strtod(text, nullptr);
    }

    using Row = std::vector<double>;

    /// The numbers of a line of @p n columns that has come to its end.
    bool
    read_row(const std::string &line, const unsigned int n, Row &row)
    {
      std::istringstream words(line);
      row.clear();
      for (std::string word; words >> word;)
        row.push_back(std::strtod(word.c_str(), nullptr)); // knows nan
      return row.size() == n;
    }

    template <int dim>
    class RowMaker
    {
    public:
      explicit RowMaker(std::vector<typename Statistics<dim>::Entry> &row)
        : row(row)
      {
        row.clear();
      }

      void
      count(const std::string &name, const std::uint64_t value)
      {
        row.push_back({name, static_cast<double>(value), true});
      }

      void
      number(const std::string &name, const double value)
      {
        row.push_back({name, value, false});
      }

      /// One column a component, with its axis; one without if there is only one.
      template <typename Components>
      void
      vector(const std::string &name,
             const std::string &unit,
             const Components  &values,
             const unsigned int n)
      {
        for (unsigned int d = 0; d < n; ++d)
          number(name + (n == 1 ? "" : std::string(" ") + "xyz"[d]) + " (" + unit + ")",
                 values[d]);
      }

      void
      motion(const std::string &prefix, const Motion<dim> &motion)
      {
        const auto name = [&](const std::string &quantity) {
          return prefix.empty() ? quantity :
                                  prefix + static_cast<char>(std::tolower(quantity[0])) +
                                    quantity.substr(1);
        };
        number(name("Kinetic energy (J)"), motion.kinetic_energy);
        vector(name("Linear momentum"), "kg m/s", motion.linear, dim);
        vector(name("Angular momentum"),
               "kg m^2/s",
               motion.angular,
               Motion<dim>::n_rotations);
      }

    private:
      std::vector<typename Statistics<dim>::Entry> &row;
    };
  } // namespace

  template <int dim>
  Statistics<dim>::Statistics(const MPI_Comm    &comm,
                              const std::string &directory,
                              const Probes<dim> &probes)
    : comm(comm)
    , path(directory + "/statistics")
    , probes(probes)
  {}

  template <int dim>
  void
  Statistics<dim>::resume(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    make_row(state, domain, StepInfo<dim>());
    const unsigned int    step = state.step;
    std::string           header, kept, error;
    std::array<double, 3> restored{}; // volume of the first row, rebuilds, emitted volume
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::ifstream            file(path);
        std::vector<std::string> names;
        Row                      values;
        for (std::string line; std::getline(file, line) && !file.eof();)
          if (line[0] == '#')
            {
              header += line + '\n';
              names.push_back(line.substr(line.find(": ") + 2));
            }
          else if (read_row(line, names.size(), values) && values[0] <= step)
            {
              const auto column = [&](const std::string &name) {
                const auto it = std::find(names.begin(), names.end(), name);
                return it == names.end() ? 0. : values[it - names.begin()];
              };
              if (kept.empty())
                restored[0] = column(volume_name<dim>());
              restored[1] = column("Rebuilds");
              restored[2] = column(emitted_name<dim>());
              kept += line + '\n';
            }
        const auto [old, now] = std::mismatch(
          names.begin(), names.end(), row.begin(), row.end(), [](const auto &name, const Entry &entry) {
            return name == entry.name;
          });
        if (!kept.empty() && (old != names.end() || now != row.end()))
          error = "The run cannot be resumed: only one of the columns of \"" + path +
                  "\" and those of this run has \"" + (old != names.end() ? *old : now->name) +
                  "\"; let the subsections Solid and Probe be as they were.";
        else if (kept.empty())
          error = "The run cannot be resumed: the table \"" + path +
                  "\" has no row before step " + std::to_string(step) + ".";
        else
          error = replace_file(path, [&](std::ostream &out) { out << header << kept; });
      }
    throw_first(comm, error);
    restored     = Utilities::MPI::broadcast(comm, restored);
    has_file     = true;
    has_first    = true;
    first_volume = restored[0];
    n_rebuilds   = std::lround(restored[1]);
    emitted      = restored[2];
  }

  template <int dim>
  void
  Statistics<dim>::add_row(const State<dim>        &state,
                           const LiquidDomain<dim> &domain,
                           const StepInfo<dim>     &info)
  {
    make_row(state, domain, info);
    append();
  }

  template <int dim>
  void
  Statistics<dim>::make_row(const State<dim>        &state,
                            const LiquidDomain<dim> &domain,
                            const StepInfo<dim>     &info)
  {
    const Measures<dim> measures = measure(state, domain);
    const double        volume   = rounded(measures.volume);
    if (!has_first)
      first_volume = volume;
    has_first = true;
    n_rebuilds += info.rebuilt;
    emitted                = rounded(emitted + info.emitted);
    const double expected = first_volume + emitted;

    RowMaker<dim> add(row);
    add.count("Time step number", state.step);
    add.number("Time (s)", state.time);
    add.number("Time step size (s)", info.dt);
    add.count("Cells", domain.mesh.cells->size());
    add.count("Nodes", domain.mesh.nodes->size());
    add.count("Faces", domain.mesh.faces->size());
    add.number(volume_name<dim>(), measures.volume);
    add.number("Volume drift", expected > 0 ? volume / expected - 1 : 0);
    add.number(emitted_name<dim>(), emitted);
    add.number(dim == 2 ? "Emission rate (m^2/s)" : "Emission rate (m^3/s)",
               info.dt > 0 ? info.emitted / info.dt : 0);
    add.vector("Centre of mass", "m", measures.centre_of_mass, dim);
    add.vector("Liquid minimum", "m", measures.lower, dim);
    add.vector("Liquid maximum", "m", measures.upper, dim);
    add.number("Potential energy (J)", measures.potential_energy);
    add.motion("", measures.of_faces);
    add.motion("Nodal ", measures.of_nodes);
    add.number("Viscous dissipation (W)", measures.dissipation);
    add.number("Maximum speed (m/s)", measures.maximum_speed);
    add.number("Maximum divergence (1/s)", info.dynamics.maximum_divergence);
    add.count("Clamped faces", domain.n_clamped_faces);
    add.count("Rebuilds", n_rebuilds);
    add.count("Viscosity iterations", info.dynamics.viscosity_iterations);
    add.count("Fallbacks", info.dynamics.fallbacks);
    add.count("Pressure iterations", info.dynamics.pressure_iterations);
    add.number("Wall time (s)", info.wall_time);
    for (unsigned int k = 0; k <= domain.scene.n_solids(); ++k)
      {
        const std::string body =
          k < domain.scene.n_solids() ? "Solid " + std::to_string(k + 1) : "Walls";
        const auto     &loads = info.dynamics.loads;
        const Load<dim> load  = loads.empty() ? Load<dim>() : loads[k];
        add.vector(body + " force", "N", load.force, dim);
        add.vector(body + " torque", "N m", load.torque, Load<dim>::n_rotations);
      }
    const auto values = probes.read(state, domain);
    for (unsigned int k = 0; k < values.size(); ++k)
      {
        const std::string probe = "Probe " + std::to_string(k + 1);
        add.vector(probe + " velocity", "m/s", values[k].velocity, dim);
        add.number(probe + " pressure (Pa)", values[k].pressure);
      }
  }

  template <int dim>
  void
  Statistics<dim>::append()
  {
    std::string error;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::ofstream file(path, has_file ? std::ios::app : std::ios::trunc);
        if (!has_file)
          for (unsigned int k = 0; k < row.size(); ++k)
            file << "# " << k + 1 << ": " << row[k].name << '\n';
        char text[64];
        for (const Entry &entry : row)
          {
            if (entry.is_count)
              std::snprintf(text, sizeof text, "%*.0f", width - 8, entry.value);
            else
              std::snprintf(text, sizeof text, "%*.11e", width, entry.value);
            file << text;
          }
        file << std::endl;
        if (!file)
          error = "The file \"" + path + "\" cannot be written.";
      }
    has_file = true;
    throw_first(comm, error);
  }

  template <int dim>
  double
  Statistics<dim>::last(const std::string &name) const
  {
    for (const Entry &entry : row)
      if (entry.name == name)
        return entry.value;
    AssertThrow(false, ExcMessage("There is no statistic \"" + name + "\"."));
    return 0;
  }

  template class Statistics<2>;
  template class Statistics<3>;
} // namespace treacle
