// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_surface_writer_h
#define treacle_io_surface_writer_h

#include <treacle/fields/liquid_domain.h>

#include <deal.II/base/parameter_handler.h>

namespace treacle
{
  /// Of the files of a frame.
  enum class SurfaceFormat
  {
    ply,
    obj,
    vtp,
    none
  };

  /// Writes the surface of the liquid outside solids with its velocity, one file a frame:
  /// closed along solids, open on the box. Which ranks there are
  /// does not change a byte of it.
  template <int dim>
  class SurfaceWriter
  {
  public:
    struct Parameters
    {
      SurfaceFormat format = SurfaceFormat::ply;

      void
      add_parameters(ParameterHandler &prm);
    };

    explicit SurfaceWriter(const Parameters &parameters)
      : format(parameters.format)
    {}

    /// `<directory>/frames/surface_00000.ply`, say. Throws a UserError on all
    /// ranks where that fails. Collective.
    void
    write(const State<dim>        &state,
          const LiquidDomain<dim> &domain,
          const std::string       &directory,
          const unsigned int       frame) const;

  private:
    SurfaceFormat format;
  };
} // namespace treacle

#endif
