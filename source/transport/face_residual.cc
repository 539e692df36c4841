// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/transport/face_residual.h>

namespace treacle
{
  namespace
  {
    /// How far faces are from each other, in leaves. With 1 an inviscid drop that is stretched across the
    /// mesh shatters, with 1/4 it does not.
    constexpr double between_faces = 0.25;

    /// Edge of the smaller leaf beside a face (m).
    template <int dim>
    double
    size_at_face(const Mesh<dim> &mesh, const LocalIndex face)
    {
      const auto &[first, second] = mesh.face_cells[face];
      return second == invalid ? mesh.cell_size[first] :
                                 std::min(mesh.cell_size[first], mesh.cell_size[second]);
    }
  } // namespace

  template <int dim>
  void
  keep_what_nodes_miss(const State<dim>              &old,
                       const LiquidDomain<dim>       &domain,
                       const double                   dt,
                       const std::vector<LocalIndex> &faces,
                       Vector                        &u)
  {
    const Mesh<dim> &mesh = domain.mesh;
    for (const LocalIndex f : faces)
      if (domain.is_liquid_face(f))
        {
          Tensor<1, dim> v;
          for (const LocalIndex node : mesh.face_nodes[f])
            v += old.v.value(node) / dim;
          const double moved  = dt * v.norm() / (between_faces * size_at_face(mesh, f));
          const double missed = old.u.local_element(f) - v * mesh.face_normal[f];
          u.local_element(f) += std::max(0., 1 - moved) * missed;
        }
  }

  template void
  keep_what_nodes_miss(const State<2> &,
                       const LiquidDomain<2> &,
                       const double,
                       const std::vector<LocalIndex> &,
                       Vector &);
  template void
  keep_what_nodes_miss(const State<3> &,
                       const LiquidDomain<3> &,
                       const double,
                       const std::vector<LocalIndex> &,
                       Vector &);
} // namespace treacle
