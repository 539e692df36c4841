// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_io_mesh_writer_h
#define treacle_io_mesh_writer_h

#include <treacle/fields/liquid_domain.h>

namespace treacle
{
  /// Of the files of a frame.
  enum class MeshFormat
  {
    vtu,
    xdmf,
    none
  };

  /// Writes the mesh with what lives on it, one set of files a frame, and the
  /// list of the frames so far with their times.
  template <int dim>
  class MeshWriter
  {
  public:
    struct Parameters
    {
      MeshFormat format = MeshFormat::vtu;

      void
      add_parameters(ParameterHandler &prm);
    };

    explicit MeshWriter(const Parameters &parameters)
      : format(parameters.format)
    {}

    /// vtu: `<directory>/frames/mesh_00000.pvtu` with a piece a rank, and
    /// `mesh.pvd`. xdmf: `mesh_00000.h5` and `mesh.xdmf`. Frames in an older
    /// list stay in it if they come before this one. Throws a UserError on all
    /// ranks where that fails. Collective.
    void
    write(const State<dim>        &state,
          const LiquidDomain<dim> &domain,
          const std::string       &directory,
          const unsigned int       frame) const;

  private:
    MeshFormat format;
  };
} // namespace treacle

#endif
