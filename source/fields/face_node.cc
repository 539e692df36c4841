// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_node.h>

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
  void
  set_prescribed(const LiquidDomain<dim> &domain, const LocalIndex node, NodeVector<dim> &v)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (domain.constrained[node] >> d & 1)
        v.component[d].local_element(node) = domain.prescribed[node][d];
  }

  template <int dim>
  void
  set_prescribed(const LiquidDomain<dim> &domain, NodeVector<dim> &v)
  {
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      set_prescribed(domain, node, v);
    v.update_ghost_values();
  }

  namespace
  {
    template <int dim>
    Tensor<1, dim>
    cell_velocity(const LiquidDomain<dim> &domain, const Vector &u, const LocalIndex cell)
    {
      const Mesh<dim> &mesh = domain.mesh;
      Tensor<2, dim>   matrix;
      Tensor<1, dim>   rhs;
      for (const LocalIndex f : mesh.cell_faces[cell])
        {
          const Tensor<1, dim> &n = mesh.face_normal[f];
          matrix += outer_product(n, n);
          rhs += (domain.is_liquid_face(f) ? u.local_element(f) : domain.solid_velocity[f]) * n;
        }
      return invert(matrix) * rhs; // any dim of the normals of a simplex are independent
    }
  } // namespace

  template <int dim>
  void
  two_step(const LiquidDomain<dim> &domain, const Vector &u, NodeVector<dim> &v)
  {
    const Mesh<dim>            &mesh = domain.mesh;
    std::vector<Tensor<1, dim>> velocity(mesh.cell_nodes.size());
    for (LocalIndex c = 0; c < velocity.size(); ++c)
      if (domain.is_active_cell[c])
        velocity[c] = cell_velocity(domain, u, c);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        if (!domain.is_active_node[node])
          continue;
        Tensor<1, dim> sum;
        double         volume = 0;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          if (const LocalIndex c = mesh.node_cells[k]; domain.is_active_cell[c])
            {
              sum += mesh.cell_volume[c] * velocity[c];
              volume += mesh.cell_volume[c];
            }
        v.set(node, sum / volume);
      }
    set_prescribed(domain, v);
  }

#define INSTANTIATE(dim)                                                                        \
  template double face_velocity(const Mesh<dim> &, const NodeVector<dim> &, const LocalIndex); \
  template void set_prescribed(const LiquidDomain<dim> &, const LocalIndex, NodeVector<dim> &); \
  template void set_prescribed(const LiquidDomain<dim> &, NodeVector<dim> &);                   \
  template void two_step(const LiquidDomain<dim> &, const Vector &, NodeVector<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
