// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/gradients.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/solvers/linear_solver.h>
#include <treacle/transport/surface_divergence.h>

#include <deal.II/lac/solver_cg.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    /// How far below the surface, in leaves, and a trifle more.
    constexpr double deep = 2.0001;
    /// Weight of the stiffness that q is smoothed with, and of the matrix's diagonal, for where no surface bounds the liquid, as between
    /// liquids in a full box, a constant q moves nothing.
    constexpr double smoothing = 0.1, least = 1e-4;
    /// In leaves: how much thicker the liquid on a wall counts, or thin films would move by whatever flows through that.
    constexpr double film = 0.25;
    /// Of the divergence, that may stay; the solve takes 5 to 10 iterations.
    constexpr double       tolerance       = 1e-2;
    constexpr unsigned int most_iterations = 30;

    /// Does the liquid at two nodes face each other, across air? Of gradients of phi.
    template <int dim>
    bool
    face_each_other(const Mesh<dim>       &mesh,
                    const NodeVector<dim> &gradient,
                    const LocalIndex       a,
                    const LocalIndex       b)
    {
      const Tensor<1, dim> at_a = gradient.value(a), at_b = gradient.value(b);
      return at_a * at_b < -0.25 &&
             (at_a - at_b) * (mesh.node_position[b] - mesh.node_position[a]) > 0;
    }

    /// Are the liquid nodes around an owned node of the air in several pieces that face each other? A cell
    /// joins those that do not.
    template <int dim>
    bool
    is_in_gap(const Mesh<dim>       &mesh,
              const Vector          &phi,
              const NodeVector<dim> &gradient,
              const LocalIndex       node)
    {
      std::vector<std::pair<LocalIndex, unsigned int>> pieces; // of each node
      const auto piece_of = [&](const LocalIndex n) {
        for (const auto &[other, piece] : pieces)
          if (other == n)
            return piece;
        pieces.emplace_back(n, pieces.size());
        return pieces.back().second;
      };
      const auto join = [&](const unsigned int to, const unsigned int from) {
        for (auto &[n, piece] : pieces)
          if (piece == from)
            piece = to;
      };
      for (unsigned int k = mesh.node_cell_start[node];
           k < mesh.node_cell_start[node + 1];
           ++k)
        {
          const auto &nodes = mesh.cell_nodes[mesh.node_cells[k]];
          for (unsigned int i = 0; i <= dim; ++i)
            if (phi.local_element(nodes[i]) < 0)
              {
                piece_of(nodes[i]);
                for (unsigned int j = 0; j < i; ++j)
                  if (phi.local_element(nodes[j]) < 0 &&
                      !face_each_other(mesh, gradient, nodes[i], nodes[j]))
                    join(piece_of(nodes[j]), piece_of(nodes[i]));
              }
        }
      // the lattice shows a thread thinner than a leaf as drops in a row: they do not face each other
      for (const auto &[a, of_a] : pieces)
        for (const auto &[b, of_b] : pieces)
          if (of_a < of_b && face_each_other(mesh, gradient, a, b))
            return true;
      return false;
    }
  } // namespace

  template <int dim>
  SurfaceDivergence<dim>::SurfaceDivergence(const State<dim>        &state,
                                            const NodeVector<dim>   &gradient,
                                            const LiquidDomain<dim> &domain)
    : domain(domain)
    , mesh(domain.mesh)
    , flowing(mesh.nodes)
  {
    find_cells(state, gradient);
    find_diagonal();
  }

  template <int dim>
  void
  SurfaceDivergence<dim>::find_cells(const State<dim> &state, const NodeVector<dim> &gradient)
  {
    const Vector &phi = state.phi;
    std::string   error;
    Vector moves(mesh.nodes), is_apart(mesh.nodes); // of a gap, or in an emitter
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        const double distance     = phi.local_element(node),
                     size         = surface_size_at_node(mesh, node);
        moves.local_element(node) = distance > -deep * size;
        is_apart.local_element(node) =
          domain.is_emitter_node[node] ||
          (distance >= 0 && distance < 2 * size && is_in_gap(mesh, phi, gradient, node));
      }
    moves.update_ghost_values();
    is_apart.update_ghost_values();
    const auto is_set = [](const Vector &mark) {
      return [&mark](const LocalIndex node) { return mark.local_element(node) > 0; };
    };
    std::vector<unsigned int> place(mesh.node_position.size(), invalid);
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      if (const auto &of_cell = mesh.cell_nodes[c];
          domain.liquid_volume[c] > 0 && std::any_of(of_cell.begin(), of_cell.end(), is_set(moves)) &&
          std::none_of(of_cell.begin(), of_cell.end(), is_set(is_apart)))
        {
          append(c, place);
          keep_error(error, [&] { append_walls(state, c); });
        }
    throw_first(mesh.communicator(), error);
    Vector mass(mesh.nodes); // a node's own rank knows all around it
    for (const Node &node : nodes)
      if (node.index < mesh.n_owned_nodes() && moves.local_element(node.index) > 0)
        mass.local_element(node.index) = node.mass;
    mass.update_ghost_values();
    for (Node &node : nodes)
      node.mass = mass.local_element(node.index);
    sum.resize(nodes.size());
    force.resize(nodes.size());
    velocity.resize(nodes.size());
  }

  template <int dim>
  void
  SurfaceDivergence<dim>::append(const LocalIndex c, std::vector<unsigned int> &place)
  {
    Cell cell{{}, domain.liquid_volume[c] / (dim + 1), mesh.cell_gradients[c]};
    for (unsigned int i = 0; i <= dim; ++i)
      {
        const LocalIndex node = mesh.cell_nodes[c][i];
        if (place[node] == invalid)
          {
            place[node] = nodes.size();
            nodes.push_back({node, 0, 0, 0, domain.constrained[node]});
          }
        cell.nodes[i] = place[node];
        nodes[place[node]].mass += cell.volume;
      }
    cells.push_back(cell);
  }

  template <int dim>
  void
  SurfaceDivergence<dim>::append_walls(const State<dim> &state, const LocalIndex c)
  {
    for (const WettedWall<dim> &part : wetted_walls(domain, state, c))
      {
        walls.push_back({static_cast<unsigned int>(cells.size() - 1), part});
        for (unsigned int i = 0; i <= dim; ++i)
          nodes[cells.back().nodes[i]].mass += film * mesh.cell_size[c] * part.weight[i] * part.area.norm();
      }
  }

  template <int dim>
  void
  SurfaceDivergence<dim>::find_diagonal()
  {
    for (const Cell &cell : cells)
      {
        double free = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            if (const Node &node = nodes[cell.nodes[i]]; is_free(node, d))
              free += std::pow(cell.volume * cell.gradient[i][d], 2) / node.mass;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            Node &node = nodes[cell.nodes[i]];
            node.diagonal += free;
            node.with_smoothing += smoothing * (dim + 1) * cell.volume * cell.gradient[i].norm_square();
          }
      }
    for (auto wall = walls.begin(), end = wall; wall != walls.end(); wall = end)
      {
        const Cell &cell = cells[wall->cell];
        end              = std::find_if(wall, walls.end(), [&](const Wall &other) { return other.cell != wall->cell; });
        for (unsigned int i = 0; i <= dim; ++i)
          for (unsigned int j = 0; j <= dim; ++j)
            for (unsigned int d = 0; d < dim; ++d)
              if (const Node &node = nodes[cell.nodes[j]]; is_free(node, d))
                {
                  const double without = cell.volume * cell.gradient[j][d];
                  const double with    = std::accumulate(wall, end, without, [&](const double sum, const Wall &w) {
                    return sum - w.part.weight[i] * w.part.weight[j] * w.part.area[d];
                  });
                  nodes[cell.nodes[i]].diagonal += (with * with - without * without) / node.mass;
                }
      }
    for (Node &node : nodes)
      node.with_smoothing += (1 + least) * node.diagonal;
  }

  template <int dim>
  void
  SurfaceDivergence<dim>::weigh(const NodeVector<dim> &v, const Vector &q, Vector &r)
  {
    std::fill(sum.begin(), sum.end(), 0.);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      velocity[k] = v.value(nodes[k].index);
    for (const Cell &cell : cells)
      {
        double         divergence = 0;
        Tensor<1, dim> g;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            divergence += velocity[cell.nodes[i]] * cell.gradient[i];
            g += q.local_element(nodes[cell.nodes[i]].index) * cell.gradient[i];
          }
        g *= smoothing * (dim + 1);
        for (unsigned int i = 0; i <= dim; ++i)
          sum[cell.nodes[i]] += cell.volume * (divergence + g * cell.gradient[i]);
      }
    distribute(
      [this](const Wall &wall) {
        return wall.part.mean([&](const unsigned int i) { return velocity[cells[wall.cell].nodes[i]]; }) * wall.part.area;
      },
      [this](const unsigned int k, const double volume) { sum[k] -= volume; });
    r = 0;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (const Node &node = nodes[k]; node.index < mesh.n_owned_nodes() && node.diagonal > 0)
        r.local_element(node.index) = sum[k] + least * node.diagonal * q.local_element(node.index);
  }

  template <int dim>
  const NodeVector<dim> &
  SurfaceDivergence<dim>::flow(const Vector &q)
  {
    std::fill(force.begin(), force.end(), Tensor<1, dim>());
    for (const Cell &cell : cells)
      {
        double whole = 0;
        for (const unsigned int k : cell.nodes)
          whole += q.local_element(nodes[k].index);
        for (unsigned int i = 0; i <= dim; ++i)
          force[cell.nodes[i]] += cell.volume * whole * cell.gradient[i];
      }
    for (const Wall &wall : walls)
      {
        const auto &of_cell = cells[wall.cell].nodes;
        const double there = wall.part.mean([&](const unsigned int i) { return q.local_element(nodes[of_cell[i]].index); });
        for (unsigned int i = 0; i <= dim; ++i)
          force[of_cell[i]] -= wall.part.weight[i] * there * wall.part.area;
      }
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (const Node &node = nodes[k]; node.index < mesh.n_owned_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          flowing.component[d].local_element(node.index) = is_free(node, d) ? force[k][d] / node.mass : 0.;
    flowing.update_ghost_values();
    return flowing;
  }

  template <int dim>
  void
  SurfaceDivergence<dim>::remove_from(NodeVector<dim> &v)
  {
    Vector d(mesh.nodes), q(mesh.nodes);
    q.update_ghost_values();
    weigh(v, q, d);
    distribute([](const Wall &wall) { return wall.part.swept; },
               [&](const unsigned int k, const double volume) {
                 if (const Node &node = nodes[k]; node.index < mesh.n_owned_nodes() && node.diagonal > 0)
                   d.local_element(node.index) += volume;
               });
    q.zero_out_ghost_values();
    const double norm = d.l2_norm();
    if (!(norm > 0))
      return;
    IterationNumberControl control(most_iterations, tolerance * norm);
    SolverCG<Vector>       solver(control);
    solver.solve(Multiplies<Vector>{[&](Vector &r, const Vector &q) {
                   q.update_ghost_values();
                   weigh(flow(q), q, r);
                   q.zero_out_ghost_values();
                 }},
                 q,
                 d,
                 Multiplies<Vector>{[this](Vector &z, const Vector &r) {
                   z = 0;
                   for (const Node &node : nodes)
                     if (node.index < mesh.n_owned_nodes() && node.diagonal > 0)
                       z.local_element(node.index) = r.local_element(node.index) / node.with_smoothing;
                 }});
    q.update_ghost_values();
    const NodeVector<dim> &change = flow(q);
    for (const Node &node : nodes)
      if (node.index < mesh.n_owned_nodes())
        v.set(node.index, v.value(node.index) - change.value(node.index));
    v.update_ghost_values();
  }

  template class SurfaceDivergence<2>;
  template class SurfaceDivergence<3>;
} // namespace treacle
