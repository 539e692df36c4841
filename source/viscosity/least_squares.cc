// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_node.h>
#include <treacle/viscosity/least_squares.h>

#include <deal.II/base/symmetric_tensor.h>

namespace treacle
{
  template <int dim>
  LeastSquares<dim>::LeastSquares(const LiquidDomain<dim> &domain, const Weight weight)
    : domain(domain)
    , weight(weight)
  {
    const Mesh<dim> &mesh     = domain.mesh;
    Vector           is_valid = mesh.zeros(mesh.nodes);
    start.push_back(0);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (domain.is_active_node[node])
        {
          active_nodes.push_back(node);
          is_valid.local_element(node) = append_node(node);
          start.push_back(faces.size());
        }
    is_valid.update_ghost_values();
    find_sources(is_valid);
  }

  template <int dim>
  bool
  LeastSquares<dim>::append_node(const LocalIndex node)
  {
    const Mesh<dim>        &mesh  = domain.mesh;
    const unsigned int      first = faces.size();
    SymmetricTensor<2, dim> matrix;
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
            matrix += weight_of(f) * symmetrize(outer_product(n, n));
            faces.push_back(f);
          }
      }
    const auto modes = eigenvectors(matrix, SymmetricTensorEigenvectorMethod::jacobi);
    bool       valid = modes[0].first > 0;
    Tensor<2, dim> inverse;
    for (const auto &[lambda, mode] : modes)
      // singular values are the roots of these
      if (lambda > 0 && lambda >= 0.01 * modes[0].first)
        inverse += outer_product(mode, mode) / lambda;
      else
        valid = false;
    for (unsigned int k = first; k < faces.size(); ++k)
      weights.push_back(weight_of(faces[k]) * inverse * mesh.face_normal[faces[k]]);
    return valid;
  }

  template <int dim>
  void
  LeastSquares<dim>::find_sources(const Vector &is_valid)
  {
    const Mesh<dim> &mesh = domain.mesh;
    source_start.push_back(0);
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      {
        const LocalIndex node = active_nodes[i];
        if (is_valid.local_element(node) > 0)
          continue;
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
            if (is_valid.local_element(other) > 0)
              sources.push_back(other);
        if (sources.size() == source_start.back())
          continue; // keeps what its own faces say
        filled_nodes.push_back(node);
        source_start.push_back(sources.size());
        std::fill(weights.begin() + start[i], weights.begin() + start[i + 1], Tensor<1, dim>());
      }
    any_filled = Utilities::MPI::max(filled_nodes.empty() ? 0 : 1, mesh.communicator()) > 0;
  }

  template <int dim>
  Tensor<1, dim>
  LeastSquares<dim>::own_value(const unsigned int i, const Vector &u) const
  {
    Tensor<1, dim> value;
    for (unsigned int k = start[i]; k < start[i + 1]; ++k)
      value += u.local_element(faces[k]) * weights[k];
    return value;
  }

  template <int dim>
  void
  LeastSquares<dim>::to_nodes(const Vector &x, NodeVector<dim> &v) const
  {
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        v.component[d].local_element(active_nodes[i]) = x.local_element(dim * i + d);
  }

  template <int dim>
  void
  LeastSquares<dim>::fill(NodeVector<dim> &v) const
  {
    v.update_ghost_values();
    for (unsigned int i = 0; i < filled_nodes.size(); ++i)
      {
        Tensor<1, dim> sum;
        for (unsigned int k = source_start[i]; k < source_start[i + 1]; ++k)
          sum += v.value(sources[k]);
        v.set(filled_nodes[i], sum / (source_start[i + 1] - source_start[i]));
      }
  }

  template <int dim>
  void
  LeastSquares<dim>::fill_transpose(Vector &x) const
  {
    NodeVector<dim> v(domain.mesh.nodes);
    to_nodes(x, v);
    for (unsigned int i = 0; i < filled_nodes.size(); ++i)
      {
        const Tensor<1, dim> part =
          v.value(filled_nodes[i]) / (source_start[i + 1] - source_start[i]);
        for (unsigned int k = source_start[i]; k < source_start[i + 1]; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            v.component[d].local_element(sources[k]) += part[d];
        v.set(filled_nodes[i], Tensor<1, dim>());
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        v.component[d].compress(VectorOperation::add);
        for (unsigned int i = 0; i < active_nodes.size(); ++i)
          x.local_element(dim * i + d) = v.component[d].local_element(active_nodes[i]);
      }
  }

  template <int dim>
  void
  LeastSquares<dim>::drop_prescribed(Vector &x) const
  {
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (domain.constrained[active_nodes[i]] >> d & 1)
          x.local_element(dim * i + d) = 0;
  }

  template <int dim>
  void
  LeastSquares<dim>::vmult(Vector &x, const Vector &u) const
  {
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      {
        const Tensor<1, dim> value = own_value(i, u);
        for (unsigned int d = 0; d < dim; ++d)
          x.local_element(dim * i + d) = value[d];
      }
    if (any_filled)
      {
        NodeVector<dim> v(domain.mesh.nodes);
        to_nodes(x, v);
        fill(v);
        for (const LocalIndex node : filled_nodes)
          {
            const auto i = std::lower_bound(active_nodes.begin(), active_nodes.end(), node) -
                           active_nodes.begin();
            for (unsigned int d = 0; d < dim; ++d)
              x.local_element(dim * i + d) = v.component[d].local_element(node);
          }
      }
    drop_prescribed(x);
  }

  template <int dim>
  void
  LeastSquares<dim>::Tvmult(Vector &u, const Vector &x) const
  {
    Vector y(x);
    drop_prescribed(y);
    if (any_filled)
      fill_transpose(y);
    u.zero_out_ghost_values();
    u = 0;
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      {
        Tensor<1, dim> value;
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = y.local_element(dim * i + d);
        for (unsigned int k = start[i]; k < start[i + 1]; ++k)
          u.local_element(faces[k]) += weights[k] * value;
      }
    u.compress(VectorOperation::add);
  }

  template <int dim>
  void
  LeastSquares<dim>::apply(const Vector &u, NodeVector<dim> &v) const
  {
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      v.set(active_nodes[i], own_value(i, u));
    if (any_filled)
      fill(v);
    set_prescribed(domain, v);
  }

  template <int dim>
  Vector
  LeastSquares<dim>::diagonal(const std::vector<Tensor<2, dim>> &blocks) const
  {
    Vector result = domain.mesh.zeros(domain.mesh.faces);
    for (unsigned int i = 0; i < active_nodes.size(); ++i)
      for (unsigned int k = start[i]; k < start[i + 1]; ++k)
        result.local_element(faces[k]) += weights[k] * (blocks[i] * weights[k]);
    result.compress(VectorOperation::add);
    return result;
  }

  template class LeastSquares<2>;
  template class LeastSquares<3>;
} // namespace treacle
