// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/thin_liquid.h>
#include <treacle/fields/thin_solids.h>
#include <treacle/scene/bodies.h>
#include <treacle/warnings.h>

namespace treacle
{
  namespace
  {
    /// Of each solid 1 if a cell may meet it, else 0. Collective.
    template <int dim>
    std::vector<double>
    solids_in_box(const LiquidDomain<dim> &domain, const double time)
    {
      const Mesh<dim>    &mesh = domain.mesh;
      std::vector<double> result(domain.scene.n_solids());
      std::string         error;
      keep_error(error, [&] {
        for (unsigned int k = 0; k < result.size(); ++k)
          for (LocalIndex c = 0; c < mesh.n_owned_cells() && result[k] == 0; ++c)
            result[k] =
              domain.scene.solid_distance(k, barycentre<dim>(mesh.cell_vertices(c)), time) < mesh.cell_size[c];
      });
      throw_first(mesh.communicator(), error);
      Utilities::MPI::max(result, mesh.communicator(), result);
      return result;
    }
  } // namespace

  Warnings::Warnings(Log &log, std::string remedy)
    : log(log)
    , remedy(std::move(remedy))
  {}

  template <int dim>
  void
  Warnings::of_step(const StepInfo<dim> &info, const double drift)
  {
    if (std::abs(drift) > told_drift + 0.05)
      {
        told_drift = std::abs(drift);
        log.line("warning: the liquid has " + digits(100 * std::abs(drift)) + " % " +
                 (drift < 0 ? "less" : "more") +
                 " volume than it should. Parts thinner than a leaf are lost, which a larger Surface "
                 "level holds; or solids leave no room.");
      }
    if (info.dynamics.fallbacks > 0)
      log.line("warning: the coupled solve stagnated; this step was split with first projection. A "
               "smaller Maximum time step, or Linear solvers/Coupled/Maximum iterations, may help.");
  }

  template <int dim>
  void
  Warnings::of_frame(const Liquid<dim> &liquid)
  {
    const LiquidDomain<dim> &domain = *liquid.domain;
    if (const double thin = thin_part(domain, liquid.state->phi); thin > std::max(0.05, 2 * told_thin))
      {
        told_thin = thin;
        log.line("warning: " + std::to_string(std::lround(100 * thin)) + " % of the liquid is thinner than a cell. Films get holes there, threads "
                 "tear, and what is left withers; " + remedy);
      }
    if (domain.emitters_rest && !told_full)
      {
        told_full = true;
        log.line("warning: the container is full. Emitters pour no more, unless solids make room.");
      }
    const double time = liquid.state->time;
    if (domain.scene.has_moving_solids())
      {
        const std::vector<double> in_box = solids_in_box(domain, time);
        for (unsigned int k = 0; k < were_in_box.size(); ++k)
          if (in_box[k] < were_in_box[k])
            log.line("warning: " + numbered("Solid", k) + " has left the box by t = " + digits(time) +
                     " s. Outside it does nothing; if that is not meant, change its motion, or enlarge the box (Domain/Lower corner and Upper "
                     "corner).");
        were_in_box = in_box;
      }
    if (domain.scene.has_solids())
      for (const unsigned int k : thin_solids(domain, time))
        if (told_solids.insert(k).second)
          log.line("warning: " + numbered("Solid", k) +
                   " is thinner than a cell where liquid is on it, which leaks through. Make it thicker, or " + remedy);
  }

  template void
  Warnings::of_step(const StepInfo<2> &, const double);
  template void
  Warnings::of_step(const StepInfo<3> &, const double);
  template void
  Warnings::of_frame(const Liquid<2> &);
  template void
  Warnings::of_frame(const Liquid<3> &);
} // namespace treacle
