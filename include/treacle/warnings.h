// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_warnings_h
#define treacle_warnings_h

#include <treacle/base/log.h>
#include <treacle/dynamics/step_info.h>
#include <treacle/surface/liquid.h>

#include <set>

namespace treacle
{
  /// Tells the log of what a user may not have meant: of what is lost or thin again when it got worse, of a solve that stagnated each time.
  class Warnings
  {
  public:
    /// @p remedy makes the cells along the surface smaller, an imperative.
    Warnings(Log &log, std::string remedy);

    /// @p drift of the volume, relative.
    template <int dim>
    void
    of_step(const StepInfo<dim> &info, const double drift);

    /// Of what is thinner than cells, emitters that have no room, and solids that are gone. Collective.
    template <int dim>
    void
    of_frame(const Liquid<dim> &liquid);

  private:
    Log                   &log;
    const std::string      remedy;
    double                 told_drift = 0;
    double                 told_thin  = 0; ///< part of the liquid
    bool                   told_full = false;
    std::set<unsigned int> told_solids;
    std::vector<double>    were_in_box; ///< solids, 1 or 0
  };
} // namespace treacle

#endif
