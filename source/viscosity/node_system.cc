// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/viscosity/node_system.h>

namespace treacle
{
  template <int dim>
  NodeSystem<dim>::NodeSystem(const LiquidDomain<dim> &domain)
    : domain(domain)
    , numbering(domain.mesh.nodes, domain.is_active_node, dim)
    , owned_nodes(numbering.owned)
    , number(numbering.number)
    , rows(numbering.rows)
  {}

  template <int dim>
  struct NodeSystem<dim>::Row
  {
    explicit Row(const unsigned int n_nodes)
      : slot(n_nodes, invalid)
    {}

    std::vector<LocalIndex>     columns; ///< nodes, that of the row first
    std::vector<Tensor<2, dim>> blocks;
    Tensor<1, dim>              force; ///< of walls in cut cells and of springs
    /// Columns of the numbering, ascending, and places in the list of columns.
    std::vector<std::pair<LocalIndex, unsigned int>> order;
    MatrixRow                                        entries; ///< scratch, of one component

    void
    start(const LocalIndex node)
    {
      for (const LocalIndex other : columns)
        slot[other] = invalid;
      columns.clear();
      blocks.clear();
      force = 0;
      block(node);
    }

    Tensor<2, dim> &
    block(const LocalIndex node)
    {
      if (slot[node] == invalid)
        {
          slot[node] = columns.size();
          columns.push_back(node);
          blocks.emplace_back();
        }
      return blocks[slot[node]];
    }

    void
    sort(const std::vector<LocalIndex> &column)
    {
      order.clear();
      for (unsigned int k = 0; k < columns.size(); ++k)
        order.emplace_back(column[columns[k]], k);
      std::sort(order.begin(), order.end());
    }

  private:
    std::vector<LocalIndex> slot; ///< node -> place in columns
  };

  template <int dim>
  void
  NodeSystem<dim>::add_stiffness(const Stiffness &stiffness,
                                 const LocalIndex node,
                                 const LocalIndex c,
                                 Row             &row) const
  {
    const auto        &nodes    = domain.mesh.cell_nodes[c];
    const unsigned int i        = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
    const double       strain   = stiffness.strain.empty() ? 0 : stiffness.strain[c];
    const double       gradient = stiffness.gradient.empty() ? 0 : stiffness.gradient[c];
    const bool         has_skin = stiffness.skin.has(c), has_kink = stiffness.kinks.has(c);
    const auto         stiff    = [&](const Tensor<1, dim> &g, const Tensor<1, dim> &other) {
      auto block = (strain + gradient) * (g * other) * Tensor<2, dim>(unit_symmetric_tensor<dim>()) +
                   strain * outer_product(other, g);
      if (has_skin)
        block += 2 * strain * stiffness.skin.block(c, g, other);
      if (has_kink)
        block += stiffness.kinks.block(c, g, other);
      return block;
    };
    const auto parts = domain.cut_cells.parts(c);
    // nodes in solids have rows of their own, for which any scale will do
    if (parts.size() == 0 || domain.solid_distance[node] <= 0)
      {
        const auto &g = domain.mesh.cell_gradients[c];
        for (unsigned int j = 0; j <= dim; ++j)
          row.block(nodes[j]) += stiff(g[i], g[j]);
      }
    for (const auto &part : parts)
      for (unsigned int k = 0; k <= dim; ++k)
        if (part.vertex[k] == i)
          for (unsigned int l = 0; l <= dim; ++l)
            {
              const Tensor<2, dim> block =
                part.fraction * stiff(part.gradient[k], part.gradient[l]);
              if (part.vertex[l] == CutCells<dim>::on_wall)
                row.force -= block * part.velocity[l];
              else
                row.block(nodes[part.vertex[l]]) += block;
            }
  }

  template <int dim>
  void
  NodeSystem<dim>::add_face_mass(const std::vector<double> &face_mass,
                                 const LocalIndex           node,
                                 const LocalIndex           c,
                                 Row                       &row) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    for (const LocalIndex f : mesh.cell_faces[c])
      {
        const auto &nodes = mesh.face_nodes[f];
        if (!domain.is_liquid_face(f) || mesh.face_cells[f][0] != c ||
            std::find(nodes.begin(), nodes.end(), node) == nodes.end())
          continue;
        const Tensor<1, dim> &n = mesh.face_normal[f];
        const Tensor<2, dim>  m = face_mass[f] / (dim * dim) * outer_product(n, n);
        for (const LocalIndex other : nodes)
          row.block(other) += m;
      }
  }

  template <int dim>
  void
  NodeSystem<dim>::assemble_row(const Mass                 mass,
                                const Stiffness           &stiffness,
                                const std::vector<double> &face_mass,
                                const LocalIndex           node,
                                Row                       &row) const
  {
    const Mesh<dim> &mesh = domain.mesh;
    row.start(node);
    for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
      if (domain.is_active_cell[mesh.node_cells[k]])
        add_stiffness(stiffness, node, mesh.node_cells[k], row);
    if (!stiffness.springs.strength.empty())
      {
        row.blocks[0] += Tensor<2, dim>(stiffness.springs.strength[node]);
        row.force += stiffness.springs.pull[node];
      }
    if (mass == Mass::nodes)
      for (unsigned int d = 0; d < dim; ++d)
        row.blocks[0][d][d] += domain.node_mass[node];
    else if (mass == Mass::faces)
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        add_face_mass(face_mass, node, mesh.node_cells[k], row);
  }

  template <int dim>
  void
  NodeSystem<dim>::insert(Row                &row,
                          const unsigned int  i,
                          const bool          decoupled,
                          Vector             &shift,
                          MatrixRows         &matrix) const
  {
    const LocalIndex node = row.columns[0];
    row.sort(numbering.column);
    for (unsigned int a = 0; a < dim; ++a)
      {
        // 1 for a component that nothing holds, lest the matrix be singular
        double &diagonal = row.blocks[0][a][a];
        diagonal         = diagonal > 0 ? diagonal : 1;
        row.entries.clear();
        if (domain.constrained[node] >> a & 1)
          {
            row.entries.emplace_back(dim * i + a, diagonal);
            matrix.append(row.entries);
            continue;
          }
        shift.local_element(dim * i + a) += row.force[a];
        const unsigned int first = decoupled ? a : 0, end = decoupled ? a + 1 : dim;
        for (const auto &[column, place] : row.order)
          {
            const LocalIndex      other = row.columns[place];
            const unsigned int    held  = domain.constrained[other];
            const Tensor<1, dim> &line  = row.blocks[place][a];
            for (unsigned int b = first; b < end; ++b)
              if (held >> b & 1)
                shift.local_element(dim * i + a) -= line[b] * domain.prescribed[other][b];
              else
                row.entries.emplace_back(dim * column + b, line[b]);
          }
        matrix.append(row.entries);
      }
  }

  template <int dim>
  typename NodeSystem<dim>::Assembled
  NodeSystem<dim>::assemble(const Mass                 mass,
                            const Stiffness           &stiffness,
                            const std::vector<double> &face_mass) const
  {
    const MPI_Comm &comm = domain.mesh.communicator();
    Assembled       result;
    result.shift.reinit(rows, comm);
    const bool has_faces = mass == Mass::faces;
    MatrixRows matrix(has_faces ? with_faces.get() : nullptr);
    const bool decoupled = !has_faces && stiffness.strain.empty();
    Row        row(domain.mesh.node_position.size());
    for (unsigned int i = 0; i < owned_nodes.size(); ++i)
      {
        assemble_row(mass, stiffness, face_mass, owned_nodes[i], row);
        insert(row, i, decoupled, result.shift, matrix);
      }
    result.matrix = matrix.take(comm, rows, numbering.ghost_columns);
    if (has_faces && !with_faces)
      with_faces = result.matrix;
    return result;
  }

  template <int dim>
  Vector
  NodeSystem<dim>::unknowns(const NodeVector<dim> &v) const
  {
    Vector x(rows, domain.mesh.communicator());
    for (unsigned int i = 0; i < owned_nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        x.local_element(dim * i + d) = domain.constrained[owned_nodes[i]] >> d & 1 ?
                                         domain.prescribed[owned_nodes[i]][d] :
                                         v.component[d].local_element(owned_nodes[i]);
    return x;
  }

  template <int dim>
  void
  NodeSystem<dim>::to_nodes(const Vector &x, NodeVector<dim> &v) const
  {
    for (unsigned int i = 0; i < owned_nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        v.component[d].local_element(owned_nodes[i]) = x.local_element(dim * i + d);
    v.update_ghost_values();
  }

  template <int dim>
  Vector
  NodeSystem<dim>::right_hand_side(const std::vector<Tensor<1, dim>> &momentum,
                                   const Assembled                   &assembled) const
  {
    Vector b(assembled.shift);
    for (unsigned int i = 0; i < owned_nodes.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const LocalIndex node = owned_nodes[i];
          if (domain.constrained[node] >> d & 1)
            b.local_element(dim * i + d) =
              assembled.matrix->diag_element(dim * number[node] + d) * domain.prescribed[node][d];
          else
            b.local_element(dim * i + d) += momentum[node][d];
        }
    return b;
  }

  template <int dim>
  std::vector<Tensor<1, dim>>
  NodeSystem<dim>::face_momentum(const Vector &u, const std::vector<double> &face_mass) const
  {
    const Mesh<dim>            &mesh = domain.mesh;
    std::vector<Tensor<1, dim>> momentum(mesh.node_position.size());
    // faces of ghosts too: all that touch an owned node are known
    for (LocalIndex f = 0; f < mesh.face_nodes.size(); ++f)
      if (domain.is_liquid_face(f))
        for (const LocalIndex node : mesh.face_nodes[f])
          momentum[node] += face_mass[f] / dim * u.local_element(f) * mesh.face_normal[f];
    return momentum;
  }

  template class NodeSystem<2>;
  template class NodeSystem<3>;
} // namespace treacle
