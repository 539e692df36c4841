// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/connected_liquid.h>
#include <treacle/fields/flood.h>

namespace treacle
{
  template <int dim>
  Vector
  label_connected(const LiquidDomain<dim> &domain, const Numbering &cells)
  {
    const Mesh<dim> &mesh  = domain.mesh;
    Vector           label = mesh.zeros(mesh.cells);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      label.local_element(c) =
        cells.number[c] == numbers::invalid_dof_index ? -1. : static_cast<double>(cells.number[c]);
    const auto across_liquid_faces = [&](const LocalIndex c, const auto &visit) {
      for (const LocalIndex f : mesh.cell_faces[c])
        for (const LocalIndex other : mesh.face_cells[f])
          if (other != invalid && other != c && domain.is_liquid_face(f))
            visit(other);
    };
    Flood(label, across_liquid_faces).run();
    return label;
  }

  std::set<GlobalIndex>
  everywhere(const MPI_Comm &comm, const std::set<GlobalIndex> &here)
  {
    std::set<GlobalIndex> all;
    for (const auto &part :
         Utilities::MPI::all_gather(comm, std::vector<GlobalIndex>(here.begin(), here.end())))
      all.insert(part.begin(), part.end());
    return all;
  }

  template Vector
  label_connected(const LiquidDomain<2> &, const Numbering &);
  template Vector
  label_connected(const LiquidDomain<3> &, const Numbering &);
} // namespace treacle
