// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_statistics_h
#define treacle_io_statistics_h

#include <treacle/dynamics/step_info.h>
#include <treacle/io/probes.h>
#include <treacle/io/table_row.h>

namespace treacle
{
  /// The table `statistics` in the output directory, one row a step. Rows are
  /// appended, so a kill loses at most a part of the last, which is dropped
  /// when the run is resumed.
  template <int dim>
  class Statistics
  {
  public:
    /// Starts a new table. The directory exists.
    Statistics(const MPI_Comm    &comm,
               const std::string &directory,
               const Probes<dim> &probes = Probes<dim>());

    /// Continue the old table behind the row of this state. Throws a UserError
    /// on all ranks if there is no such table, or one with other columns. Collective.
    void
    resume(const State<dim> &state, const LiquidDomain<dim> &domain);

    /// Without loads zeros are written. Collective; throws a UserError on all ranks if
    /// the file cannot be written.
    void
    add_row(const State<dim>        &state,
            const LiquidDomain<dim> &domain,
            const StepInfo<dim>     &info);

    /// Of the last row, on all ranks, by the name of its column.
    double
    last(const std::string &name) const;

  private:
    void
    make_row(const State<dim>        &state,
             const LiquidDomain<dim> &domain,
             const StepInfo<dim>     &info);

    void
    append();

    MPI_Comm          comm;
    std::string       path;
    const Probes<dim> probes;
    bool              has_file     = false;
    bool              has_first    = false;
    double            first_volume = 0; ///< of the first row (m^dim)
    double            emitted      = 0; ///< since the start (m^dim)
    unsigned int      n_rebuilds   = 0;
    TableRow          row;
  };
} // namespace treacle

#endif
