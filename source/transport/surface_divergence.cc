// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/solvers/linear_solver.h>
#include <treacle/transport/surface_divergence.h>

#include <deal.II/lac/solver_cg.h>

namespace treacle
{
  namespace
  {
    /// How far below the surface, in leaves, and a trifle more.
    constexpr double deep = 2.0001;
    /// Weight of the stiffness that q is smoothed with, and of the matrix's diagonal, for where no surface bounds the liquid, as between
    /// liquids in a full box, a constant q moves nothing.
    constexpr double smoothing = 0.1, least = 1e-4;
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

    template <int dim>
    class SurfaceDivergence
    {
    public:
      /// Collective.
      SurfaceDivergence(const Vector            &phi,
                        const NodeVector<dim>   &gradient,
                        const LiquidDomain<dim> &domain)
        : domain(domain)
        , mesh(domain.mesh)
        , mass(mesh.nodes)
        , diagonal(mesh.nodes)
        , preconditioner(mesh.nodes)
      {
        find_cells(phi, gradient);
        find_diagonal();
      }

      /// Collective.
      void
      remove_from(NodeVector<dim> &v) const
      {
        Vector d(mesh.nodes), q(mesh.nodes);
        q.update_ghost_values();
        weigh(v, q, d);
        q.zero_out_ghost_values();
        const double norm = d.l2_norm();
        if (!(norm > 0))
          return;
        IterationNumberControl control(most_iterations, tolerance * norm);
        SolverCG<Vector>       solver(control);
        solver.solve(Multiplies<Vector>{[this](Vector &r, const Vector &q) {
                       q.update_ghost_values();
                       weigh(flow(q), q, r);
                       q.zero_out_ghost_values();
                     }},
                     q,
                     d,
                     Multiplies<Vector>{[this](Vector &z, const Vector &r) {
                       for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
                         z.local_element(node) =
                           has_weight(node) ?
                             r.local_element(node) / preconditioner.local_element(node) :
                             0.;
                     }});
        q.update_ghost_values();
        const NodeVector<dim> change = flow(q);
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          v.set(node, v.value(node) - change.value(node));
        v.update_ghost_values();
      }

    private:
      struct Cell
      {
        LocalIndex index;
        double     volume; ///< of its liquid, over the number of its nodes
      };

      /// The cells whose divergence counts are those of the nodes that move; theirs weigh
      /// it, so that it cannot go elsewhere.
      void
      find_cells(const Vector &phi, const NodeVector<dim> &gradient)
      {
        Vector moves(mesh.nodes), is_apart(mesh.nodes); // of a gap, or in an emitter
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            const double distance     = phi.local_element(node),
                         size         = surface_size_at_node(mesh, node);
            moves.local_element(node) = distance > -deep * size;
            is_apart.local_element(node) =
              domain.is_emitter_node[node] || (distance >= 0 && distance < 2 * size &&
                                               is_in_gap(mesh, phi, gradient, node));
          }
        moves.update_ghost_values();
        is_apart.update_ghost_values();
        const auto is_set = [](const Vector &mark) {
          return [&mark](const LocalIndex node) { return mark.local_element(node) > 0; };
        };
        std::vector<double> volume(mesh.node_position.size());
        for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
          if (const auto &nodes = mesh.cell_nodes[c];
              domain.liquid_volume[c] > 0 &&
              std::any_of(nodes.begin(), nodes.end(), is_set(moves)) &&
              std::none_of(nodes.begin(), nodes.end(), is_set(is_apart)))
            {
              cells.push_back({c, domain.liquid_volume[c] / (dim + 1)});
              for (const LocalIndex node : nodes)
                volume[node] += cells.back().volume;
            }
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          mass.local_element(node) = moves.local_element(node) > 0 ? volume[node] : 0.;
        mass.update_ghost_values();
      }

      bool
      is_free(const LocalIndex node, const unsigned int d) const
      {
        return mass.local_element(node) > 0 && !(domain.constrained[node] >> d & 1);
      }

      bool
      has_weight(const LocalIndex node) const
      {
        return diagonal.local_element(node) > 0;
      }

      /// Of the matrix, about: the sum of its cells' own. What nothing beside it can move
      /// has no weight. Smoothing is much the larger part of it where a cell has little liquid.
      void
      find_diagonal()
      {
        std::vector<double> sum(mesh.node_position.size()), smoothed(sum);
        for (const Cell &cell : cells)
          {
            double free = 0;
            for (unsigned int i = 0; i <= dim; ++i)
              for (unsigned int d = 0; d < dim; ++d)
                if (const LocalIndex node = mesh.cell_nodes[cell.index][i];
                    is_free(node, d))
                  free +=
                    std::pow(cell.volume * mesh.cell_gradients[cell.index][i][d], 2) /
                    mass.local_element(node);
            for (unsigned int i = 0; i <= dim; ++i)
              {
                sum[mesh.cell_nodes[cell.index][i]] += free;
                smoothed[mesh.cell_nodes[cell.index][i]] +=
                  smoothing * (dim + 1) * cell.volume * mesh.cell_gradients[cell.index][i].norm_square();
              }
          }
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            diagonal.local_element(node)       = sum[node];
            preconditioner.local_element(node) = (1 + least) * sum[node] + smoothed[node];
          }
      }

      /// r = B v + (0.1 L + 1e-4 D) q, D the diagonal.
      void
      weigh(const NodeVector<dim> &v, const Vector &q, Vector &r) const
      {
        std::vector<double> sum(mesh.node_position.size());
        for (const Cell &cell : cells)
          {
            const double         part = trace(velocity_gradient(mesh, cell.index, v));
            const Tensor<1, dim> g = smoothing * (dim + 1) * cell_gradient(mesh, cell.index, q);
            for (unsigned int i = 0; i <= dim; ++i)
              sum[mesh.cell_nodes[cell.index][i]] +=
                cell.volume * (part + g * mesh.cell_gradients[cell.index][i]);
          }
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          r.local_element(node) =
            has_weight(node) ?
              sum[node] + least * diagonal.local_element(node) * q.local_element(node) :
              0.;
      }

      /// M^-1 B^T q, where no component is prescribed.
      NodeVector<dim>
      flow(const Vector &q) const
      {
        std::vector<Tensor<1, dim>> sum(mesh.node_position.size());
        for (const Cell &cell : cells)
          {
            double whole = 0;
            for (const LocalIndex node : mesh.cell_nodes[cell.index])
              whole += q.local_element(node);
            for (unsigned int i = 0; i <= dim; ++i)
              sum[mesh.cell_nodes[cell.index][i]] +=
                cell.volume * whole * mesh.cell_gradients[cell.index][i];
          }
        NodeVector<dim> v(mesh.nodes);
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          for (unsigned int d = 0; d < dim; ++d)
            v.component[d].local_element(node) =
              is_free(node, d) ? sum[node][d] / mass.local_element(node) : 0.;
        v.update_ghost_values();
        return v;
      }

      const LiquidDomain<dim> &domain;
      const Mesh<dim>         &mesh;
      std::vector<Cell>        cells;
      Vector mass;     ///< liquid of these cells about a node that moves (m^dim)
      Vector diagonal; ///< without smoothing; positive where a node has a weight
      Vector preconditioner;
    };
  } // namespace

  template <int dim>
  void
  remove_divergence_at_surface(const Vector            &phi,
                               const NodeVector<dim>   &gradient,
                               const LiquidDomain<dim> &domain,
                               NodeVector<dim>         &v)
  {
    SurfaceDivergence<dim>(phi, gradient, domain).remove_from(v);
  }

  template void
  remove_divergence_at_surface(const Vector &,
                               const NodeVector<2> &,
                               const LiquidDomain<2> &,
                               NodeVector<2> &);
  template void
  remove_divergence_at_surface(const Vector &,
                               const NodeVector<3> &,
                               const LiquidDomain<3> &,
                               NodeVector<3> &);
} // namespace treacle
