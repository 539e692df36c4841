// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_probes_h
#define treacle_io_probes_h

#include <treacle/fields/liquid_domain.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// Points at which velocity and pressure are read in every step.
  template <int dim>
  class Probes
  {
  public:
    struct Parameters
    {
      std::vector<Point<dim>> positions; // m

      /// Subsections Probe 1 to n; @p prm writes into this object when it parses.
      void
      add_parameters(ParameterHandler &prm, const unsigned int n);
    };

    explicit Probes(const Parameters &parameters = Parameters())
      : positions(parameters.positions)
    {}

    unsigned int
    size() const
    {
      return positions.size();
    }

    /// Throws a UserError on all ranks if a probe lies outside the box.
    void
    check(const Scene<dim> &scene) const;

    /// Throws a UserError on all ranks if a probe lies outside a mesh that need
    /// not be a box. Collective.
    void
    check(const Mesh<dim> &mesh) const;

    struct Values
    {
      Tensor<1, dim> velocity; ///< m/s
      double         pressure; ///< Pa
    };

    /// Of each probe, on all ranks; zero outside the liquid. Collective.
    std::vector<Values>
    read(const State<dim> &state, const LiquidDomain<dim> &domain) const;

  private:
    std::vector<Point<dim>> positions;
  };
} // namespace treacle

#endif
