// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/dynamics/measures.h>
#include <treacle/io/old_table.h>
#include <treacle/io/statistics.h>
#include <treacle/scene/bodies.h>
#include <treacle/transport/time_step.h>

#include <fstream>

namespace treacle
{
  namespace
  {
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

    template <int dim>
    void
    add_motion(TableRow &row, const std::string &prefix, const Motion<dim> &motion)
    {
      const auto name = [&](const std::string &quantity) {
        return prefix.empty() ? quantity :
                                prefix + static_cast<char>(std::tolower(quantity[0])) +
                                  quantity.substr(1);
      };
      row.number(name("Kinetic energy (J)"), motion.kinetic_energy);
      row.vector(name("Linear momentum"), "kg m/s", motion.linear, dim);
      row.vector(name("Angular momentum"),
                 "kg m^2/s",
                 motion.angular,
                 Motion<dim>::n_rotations);
    }

    template <int dim>
    void
    add_measures(TableRow &row, const Measures<dim> &measures)
    {
      row.vector("Centre of mass", "m", measures.centre_of_mass, dim);
      row.vector("Liquid minimum", "m", measures.lower, dim);
      row.vector("Liquid maximum", "m", measures.upper, dim);
      row.number("Potential energy (J)", measures.potential_energy);
      add_motion(row, "", measures.of_faces);
      add_motion(row, "Nodal ", measures.of_nodes);
      row.number("Viscous dissipation (W)", measures.dissipation);
      row.number("Maximum speed (m/s)", measures.maximum_speed);
    }

    /// Without loads they are zero.
    template <int dim>
    void
    add_loads(TableRow                     &row,
              const unsigned int            n_solids,
              const std::vector<Load<dim>> &loads)
    {
      for (unsigned int k = 0; k <= n_solids; ++k)
        {
          const std::string body = k < n_solids ? numbered("Solid", k) : "Walls";
          const Load<dim>   load = loads.empty() ? Load<dim>() : loads[k];
          row.vector(body + " force", "N", load.force, dim);
          row.vector(body + " torque", "N m", load.torque, Load<dim>::n_rotations);
        }
    }

    template <int dim>
    void
    add_probes(TableRow &row, const std::vector<typename Probes<dim>::Values> &values)
    {
      for (unsigned int k = 0; k < values.size(); ++k)
        {
          row.vector(numbered("Probe", k) + " velocity", "m/s", values[k].velocity, dim);
          row.number(numbered("Probe", k) + " pressure (Pa)", values[k].pressure);
        }
    }
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
    std::string           error;
    std::array<double, 3> restored{}; // volume of the first row, rebuilds, emitted volume
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        const OldTable table(path, state.step);
        restored = {{table.first_value(volume_name<dim>()),
                     table.last_value("Rebuilds"),
                     table.last_value(emitted_name<dim>())}};
        error    = table.why_not_resumed(row.names());
        if (error.empty())
          error = table.rewrite();
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
    const double        volume   = TableRow::rounded(measures.volume);
    if (!has_first)
      first_volume = volume;
    has_first = true;
    n_rebuilds += info.rebuilt;
    emitted               = TableRow::rounded(emitted + info.emitted);
    const double expected = first_volume + emitted;

    row = TableRow();
    row.count("Time step number", state.step);
    row.number("Time (s)", state.time);
    row.number("Time step size (s)", info.dt);
    row.count("Cells", domain.mesh.cells->size());
    row.count("Nodes", domain.mesh.nodes->size());
    row.count("Faces", domain.mesh.faces->size());
    row.number(volume_name<dim>(), measures.volume);
    row.number("Volume drift", expected > 0 ? volume / expected - 1 : 0);
    row.number(emitted_name<dim>(), emitted);
    row.number(dim == 2 ? "Emission rate (m^2/s)" : "Emission rate (m^3/s)",
               info.dt > 0 ? info.emitted / info.dt : 0);
    add_measures(row, measures);
    row.number("Maximum divergence (1/s)", info.dynamics.maximum_divergence);
    row.number("Drift before correction", info.drift);
    row.number("Energy excess", info.excess);
    row.number("CFL number", info.dt * fastest_crossing(domain, state.v));
    row.count("Repetitions", info.repetitions.all());
    row.count("Repetitions for volume", info.repetitions.volume);
    row.count("Repetitions for motion", info.repetitions.motion);
    row.count("Repetitions for energy", info.repetitions.energy);
    row.count("Clamped faces", domain.n_clamped_faces);
    row.count("Rebuilds", n_rebuilds);
    row.count("Viscosity iterations", info.dynamics.viscosity_iterations);
    row.count("Fallbacks", info.dynamics.fallbacks);
    row.count("Pressure iterations", info.dynamics.pressure_iterations);
    row.number("Wall time (s)", info.wall_time);
    add_loads(row, domain.scene.n_solids(), info.dynamics.loads);
    add_probes<dim>(row, probes.read(state, domain));
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
          row.write_header(file);
        row.write(file);
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
    return row.value(name);
  }

  template class Statistics<2>;
  template class Statistics<3>;
} // namespace treacle
