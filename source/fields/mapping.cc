// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/mapping.h>

#include <deal.II/base/symmetric_tensor.h>

namespace treacle
{
  template <int dim>
  double
  face_velocity(const Mesh<dim> &mesh, const NodeVector<dim> &v, const LocalIndex face)
  {
    double u = 0;
    for (const LocalIndex node : mesh.face_nodes[face])
      u += v.value(node) * mesh.face_normal[face];
    return u / dim;
  }

  template <int dim>
  bool
  mean_of_neighbours(const Mesh<dim>       &mesh,
                     const NodeVector<dim> &v,
                     const Vector          &counts,
                     const LocalIndex       node,
                     Tensor<1, dim>        &mean)
  {
    unsigned int n = 0;
    mean           = 0;
    for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
      for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
        if (counts.local_element(other) > 0)
          {
            mean += v.value(other);
            ++n;
          }
    if (n > 0)
      mean /= n;
    return n > 0;
  }

  namespace
  {
    /// Invalid nodes receive the mean of their valid neighbours.
    template <int dim>
    void
    fill_invalid(const LiquidDomain<dim> &domain, const Vector &is_valid, NodeVector<dim> &v)
    {
      const Mesh<dim> &mesh = domain.mesh;
      Tensor<1, dim>   mean;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (is_valid.local_element(node) == 0 && domain.is_active_node[node] &&
            mean_of_neighbours(mesh, v, is_valid, node, mean))
          v.set(node, mean);
    }
  } // namespace

  template <int dim>
  void
  set_prescribed(const LiquidDomain<dim> &domain, NodeVector<dim> &v)
  {
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        if (domain.constrained[node] >> d & 1)
          v.component[d].local_element(node) = domain.prescribed[node][d];
    v.update_ghost_values();
  }

  template <int dim>
  void
  least_squares(const LiquidDomain<dim> &domain, const Vector &u, NodeVector<dim> &v)
  {
    const Mesh<dim> &mesh = domain.mesh;
    Vector           is_valid = mesh.zeros(mesh.nodes);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        if (!domain.is_active_node[node])
          continue;
        SymmetricTensor<2, dim> matrix;
        Tensor<1, dim>          rhs;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          {
            const LocalIndex c = mesh.node_cells[k];
            for (unsigned int i = 0; i <= dim; ++i)
              {
                const LocalIndex f = mesh.cell_faces[c][i];
                if (mesh.cell_nodes[c][i] == node || mesh.face_cells[f][0] != c ||
                    !domain.is_liquid_face(f))
                  continue;
                const Tensor<1, dim> &n = mesh.face_normal[f];
                matrix += symmetrize(outer_product(n, n));
                rhs += u.local_element(f) * n;
              }
          }
        Tensor<1, dim> velocity;
        const auto     modes = eigenvectors(matrix, SymmetricTensorEigenvectorMethod::jacobi);
        bool           valid = modes[0].first > 0;
        for (const auto &[lambda, mode] : modes)
          // singular values are the roots of these
          if (lambda > 0 && lambda >= 0.01 * modes[0].first)
            velocity += (mode * rhs) / lambda * mode;
          else
            valid = false;
        v.set(node, velocity);
        is_valid.local_element(node) = valid;
      }
    v.update_ghost_values();
    is_valid.update_ghost_values();
    fill_invalid(domain, is_valid, v);
    set_prescribed(domain, v);
  }

#define INSTANTIATE(dim)                                                                        \
  template double face_velocity(const Mesh<dim> &, const NodeVector<dim> &, const LocalIndex); \
  template bool mean_of_neighbours(const Mesh<dim> &,                                           \
                                   const NodeVector<dim> &,                                     \
                                   const Vector &,                                              \
                                   const LocalIndex,                                            \
                                   Tensor<1, dim> &);                                           \
  template void set_prescribed(const LiquidDomain<dim> &, NodeVector<dim> &);                   \
  template void least_squares(const LiquidDomain<dim> &, const Vector &, NodeVector<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
