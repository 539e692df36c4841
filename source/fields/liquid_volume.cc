// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/liquid_volume.h>
#include <treacle/geometry/cut_simplex.h>

namespace treacle
{
  template <int dim>
  double
  liquid_volume(const MeshData<dim> &data, const Vector &phi, const double time)
  {
    const Mesh<dim>           &mesh   = data.mesh;
    const std::vector<double> &psi    = data.solid_distance(time);
    double                     volume = 0;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (has_liquid(mesh, phi, c))
        volume +=
          liquid_moments<dim>(mesh.cell_vertices(c), mesh.values(c, phi), mesh.values(c, psi)).volume;
    return Utilities::MPI::sum(volume, mesh.communicator());
  }

  template double
  liquid_volume(const MeshData<2> &, const Vector &, const double);
  template double
  liquid_volume(const MeshData<3> &, const Vector &, const double);
} // namespace treacle
