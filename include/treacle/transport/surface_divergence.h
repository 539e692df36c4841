// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_transport_surface_divergence_h
#define treacle_transport_surface_divergence_h

#include <treacle/fields/wetted_walls.h>

namespace treacle
{
  /// The projection keeps the volume that flows through faces; a node velocity fitted to
  /// them and continued into the air does not, and where the surface is curved as sharply
  /// as a leaf, as about a stream that enters a pool, it loses a third of what flows
  /// there. This takes the divergence of v out of the liquid within two leaves of the
  /// surface, less what flows through walls: the least change of its nodes, in the mean over the liquid, after which it is zero in the
  /// liquid of their cells in the mean with each P1 weight,
  ///
  ///   v - M^-1 B^T q,   (B M^-1 B^T + 0.1 L) q = B v - b,
  ///
  /// with (B v)_i the integral of lambda_i div v less that of lambda_i v·n over the walls which the liquid touches (n out of it), b_i
  /// what these sweep into it, M the lumped volume of the liquid and of a quarter of a leaf more on walls, and
  /// L the stiffness of q, without which weights that alternate from node to node are
  /// hardly seen. As the weights sum to one, and L q to zero, what flows through the
  /// surface is right as a whole. Components that are prescribed stay. Not in gaps
  /// between liquid thinner than a cell, whose air is to go, nor beside emitters.
  template <int dim>
  class SurfaceDivergence
  {
  public:
    /// The gradient of phi at nodes, with up-to-date ghosts; @p domain must outlive this object. Collective; throws a UserError.
    SurfaceDivergence(const State<dim> &state, const NodeVector<dim> &gradient, const LiquidDomain<dim> &domain);

    /// Of v (m/s), with up-to-date ghosts before and after. Collective.
    void
    remove_from(NodeVector<dim> &v);

  private:
    /// Those whose divergence counts, in a row.
    struct Cell
    {
      std::array<unsigned int, dim + 1>   nodes;    ///< by their place in Nodes
      double                              volume;   ///< of its liquid, over the number of its nodes
      std::array<Tensor<1, dim>, dim + 1> gradient; ///< of the nodes' weights (1/m)
    };

    /// Of these cells.
    struct Wall
    {
      unsigned int    cell; ///< by its place in cells, in their order
      WettedWall<dim> part;
    };

    /// The nodes of these cells.
    struct Node
    {
      LocalIndex    index;
      double        mass;       ///< M, of these cells about a node that moves (m^dim); 0 if it does not
      double        diagonal;   ///< of the matrix, without smoothing; positive where an owned node has a weight
      double        with_smoothing;
      unsigned char constrained; ///< by components
    };

    /// The cells whose divergence counts are those of the nodes that move; theirs weigh
    /// it, so that it cannot go elsewhere.
    void
    find_cells(const State<dim> &state, const NodeVector<dim> &gradient);

    /// A cell, and its nodes that have no place yet.
    void
    append(const LocalIndex cell, std::vector<unsigned int> &place);

    /// The walls in the last cell, which is the mesh's @p c. Throws a UserError.
    void
    append_walls(const State<dim> &state, const LocalIndex c);

    bool
    is_free(const Node &node, const unsigned int d) const
    {
      return node.mass > 0 && !(node.constrained >> d & 1);
    }

    /// Share what @p through (wall) says among the nodes of its cell by their weights: to (node, part).
    template <typename Through, typename To>
    void
    distribute(const Through &through, const To &to) const
    {
      for (const Wall &wall : walls)
        {
          const double volume = through(wall);
          for (unsigned int i = 0; i <= dim; ++i)
            to(cells[wall.cell].nodes[i], wall.part.weight[i] * volume);
        }
    }

    /// Of the matrix, about: the sum of its cells' own. What nothing beside it can move
    /// has no weight. Smoothing is much the larger part of it where a cell has little liquid.
    void
    find_diagonal();

    /// r = B v + (0.1 L + 1e-4 D) q, D the diagonal. Ghosts are up to date.
    void
    weigh(const NodeVector<dim> &v, const Vector &q, Vector &r);

    /// M^-1 B^T q, where no component is prescribed; ghosts are up to date.
    const NodeVector<dim> &
    flow(const Vector &q);

    const LiquidDomain<dim> &domain;
    const Mesh<dim>         &mesh;
    std::vector<Cell>        cells;
    std::vector<Wall>        walls;
    std::vector<Node>        nodes;
    // scratch
    NodeVector<dim>             flowing;
    std::vector<double>         sum;
    std::vector<Tensor<1, dim>> force, velocity;
  };
} // namespace treacle

#endif
