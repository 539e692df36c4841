// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/layers.h>
#include <treacle/fields/solid_normal.h>
#include <treacle/transport/surface_velocity.h>
#include <treacle/transport/velocity_in_time.h>

namespace treacle
{
  namespace
  {
    /// Set the @p components of v, by a mask for each node, to the mean over the known nodes
    /// around it, layer by layer.
    template <int dim>
    void
    continue_velocity(const MeshData<dim>              &data,
                      Vector                           &is_known,
                      const std::vector<unsigned char> &components,
                      const unsigned int                n_layers,
                      NodeVector<dim>                  &v)
    {
      continue_outwards(
        data,
        is_known,
        n_layers,
        [&](const LocalIndex node) { return v.value(node); },
        [&](const LocalIndex node, const Tensor<1, dim> &value) {
          for (unsigned int d = 0; d < dim; ++d)
            if (components[node] >> d & 1)
              v.component[d].local_element(node) = value[d];
        },
        [&] { v.update_ghost_values(); });
    }

    /// The velocity gradient at free nodes in the liquid, mean over the cells around a node that
    /// lie in it, row by row; is_known tells where there is one.
    template <int dim>
    struct GradientInLiquid
    {
      std::vector<NodeVector<dim>> row;
      Vector                       is_known;

      GradientInLiquid(const State<dim>        &state,
                       const LiquidDomain<dim> &domain,
                       const NodeVector<dim>   &v)
        : is_known(state.mesh->nodes)
      {
        const Mesh<dim> &mesh = *state.mesh;
        row.reserve(dim); // a vector of them that grows would lose their ghosts
        for (unsigned int d = 0; d < dim; ++d)
          row.emplace_back(mesh.nodes);
        const auto is_liquid = [&](const LocalIndex node) {
          return state.phi.local_element(node) <= 0;
        };
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          {
            if (!is_liquid(node) || domain.constrained[node] != 0)
              continue;
            Tensor<2, dim> gradient;
            const bool     is_found = mean_of_cells(
              mesh,
              node,
              [&](const LocalIndex c) {
                const auto &nodes = mesh.cell_nodes[c];
                return std::all_of(nodes.begin(), nodes.end(), is_liquid);
              },
              [&](const LocalIndex c) { return velocity_gradient(mesh, c, v); },
              gradient);
            if (!is_found)
              continue;
            is_known.local_element(node) = 1;
            for (unsigned int d = 0; d < dim; ++d)
              row[d].set(node, gradient[d]);
          }
        is_known.update_ghost_values();
        for (NodeVector<dim> &r : row)
          r.update_ghost_values();
      }
    };

    /// What the linear continuation adds to v at active nodes in the air, and beyond them.
    template <int dim>
    NodeVector<dim>
    linear_part(const State<dim>        &state,
                const LiquidDomain<dim> &domain,
                const NodeVector<dim>   &v,
                const double             distance)
    {
      const Mesh<dim>            &mesh = *state.mesh;
      const GradientInLiquid<dim> gradient(state, domain, v);
      NodeVector<dim>             added(mesh.nodes);
      Vector                      is_known(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          is_known.local_element(node) =
            state.phi.local_element(node) <= 0 || domain.is_active_node[node];
          if (state.phi.local_element(node) <= 0 || !domain.is_active_node[node])
            continue;
          Tensor<1, dim> mean;
          const bool     is_found = mean_of_neighbours(
            domain.data,
            node,
            [&](const LocalIndex other) { return gradient.is_known.local_element(other) > 0; },
            [&](const LocalIndex other) {
              const Tensor<1, dim> d = mesh.node_position[node] - mesh.node_position[other];
              Tensor<1, dim>       linear = v.value(other);
              for (unsigned int a = 0; a < dim; ++a)
                linear[a] += gradient.row[a].value(other) * d;
              return linear;
            },
            mean);
          if (is_found)
            added.set(node, mean - v.value(node));
        }
      constexpr unsigned char all = (1u << dim) - 1;
      // nodes lie at least half a leaf apart
      const unsigned int n_layers = std::ceil(2 * distance / mesh.finest_size());
      continue_velocity(
        domain.data, is_known, std::vector<unsigned char>(mesh.n_owned_nodes(), all), n_layers, added);
      return added;
    }

    /// The speed along @p n (unit) of a node in a solid with which it is the solid's on the wall: it has the slope that
    /// least squares give it between the wall and the free nodes around, no farther in than they are out.
    template <int dim>
    double
    speed_behind_wall(const LiquidDomain<dim> &domain,
                      const LocalIndex         node,
                      const Tensor<1, dim>    &n,
                      const NodeVector<dim>   &v)
    {
      const double wall    = domain.prescribed[node] * n;
      double       product = 0, square = 0, farthest = 0;
      for (const auto &neighbour : domain.data.neighbours(node))
        if (const double distance = domain.solid_distance[neighbour.node];
            distance > 0 && domain.constrained[neighbour.node] == 0)
          {
            product += distance * (v.value(neighbour.node) * n - wall);
            square += distance * distance;
            farthest = std::max(farthest, distance);
          }
      return square == 0 ? wall :
                           wall + product / square * std::max(domain.solid_distance[node], -farthest);
    }

    /// How far the surface at an owned node of a wall or in a solid faces that, whose normal @p n leads out of the liquid: 1 for one along it,
    /// which is to come to it, 0 for one that stands on it or leans back, which moves along it, and where the liquid is; no jumps, as what
    /// flips by rounding would make the result depend on the partition.
    template <int dim>
    double
    part_that_faces(const State<dim> &state, const LocalIndex node, const Tensor<1, dim> &n)
    {
      constexpr double beside = 0.1; // leaves from the liquid
      const double     away = state.phi.local_element(node) / (beside * state.mesh->finest_size());
      if (away <= 0)
        return 0;
      const MeanGradient<dim> slope = mean_gradient(*state.mesh, state.phi, node);
      const double            faces = slope.length > 0 ? 1 - (slope.mean.norm() - slope.mean * n) / slope.length : 1.;
      return std::min(away, 1.) * std::clamp(faces, 0., 1.);
    }

    /// Of the walls of each kind that meet at an owned node, in the mean, out of the mesh; zero for both sides of a plate.
    template <int dim>
    std::array<Tensor<1, dim>, Walls<dim>::n>
    wall_normals(const Mesh<dim> &mesh, const LocalIndex node)
    {
      std::array<Tensor<1, dim>, Walls<dim>::n> normals;
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        for (const LocalIndex f : mesh.cell_faces[mesh.node_cells[k]])
          if (const auto &of_face = mesh.face_nodes[f];
              mesh.face_side[f] != Mesh<dim>::no_side && std::find(of_face.begin(), of_face.end(), node) != of_face.end())
            normals[mesh.face_side[f]] += mesh.face_area[f] * mesh.face_normal[f];
      for (Tensor<1, dim> &normal : normals)
        normal /= normal.norm() > 0 ? normal.norm() : 1;
      return normals;
    }

    /// What liquid touches of walls and solids it does not go through: there v has the speed of these along their normal, at nodes up to a
    /// @p distance (m) from the liquid as far as these do not face it.
    template <int dim>
    void
    stop_at_walls(const State<dim>        &state,
                  const LiquidDomain<dim> &domain,
                  const double             distance,
                  NodeVector<dim>         &v)
    {
      const auto is_near   = [&](const LocalIndex node) { return state.phi.local_element(node) <= distance; };
      const auto set_speed = [&](const LocalIndex node, const Tensor<1, dim> &n, const double speed) {
        if (n.norm_square() == 0)
          return;
        const double other = speed * n.norm_square() - v.value(node) * n;
        v.set(node, v.value(node) + (1 - part_that_faces(state, node, n)) * other * n);
      };
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        if (domain.solid_distance[node] <= 0 && is_near(node))
          {
            const Tensor<1, dim> n = -solid_normal(domain, node);
            set_speed(node, n, speed_behind_wall(domain, node, n, v));
          }
      // later, for those in solids follow free nodes, which may lie on sides
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        if (domain.mesh.node_sides[node] != 0 && is_near(node) && !domain.is_emitter_node[node])
          for (const Tensor<1, dim> &n : wall_normals(domain.mesh, node))
            set_speed(node, n, 0);
      v.update_ghost_values();
    }

    /// Set v at nodes of walls and in solids to that of the nodes beside them: with that of a wall P1 functions would never bring the surface
    /// there.
    template <int dim>
    void
    continue_at_walls(const LiquidDomain<dim> &domain, NodeVector<dim> &v)
    {
      Vector is_known(domain.mesh.nodes);
      for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
        is_known.local_element(node) = domain.constrained[node] == 0 || domain.is_emitter_node[node];
      continue_velocity(domain.data, is_known, domain.constrained, 3, v);
    }
  } // namespace

  template <int dim>
  NodeVector<dim>
  surface_velocity(const State<dim>        &state,
                   const LiquidDomain<dim> &domain,
                   const NodeVector<dim>   &v,
                   const double             distance,
                   SurfaceDivergence<dim>  *divergence)
  {
    NodeVector<dim> result = combined(1, v, 1, linear_part(state, domain, v, distance));
    continue_at_walls(domain, result);
    stop_at_walls(state, domain, distance, result);
    if (divergence != nullptr)
      divergence->remove_from(result);
    return result;
  }

  template NodeVector<2>
  surface_velocity(const State<2> &,
                   const LiquidDomain<2> &,
                   const NodeVector<2> &,
                   const double,
                   SurfaceDivergence<2> *);
  template NodeVector<3>
  surface_velocity(const State<3> &,
                   const LiquidDomain<3> &,
                   const NodeVector<3> &,
                   const double,
                   SurfaceDivergence<3> *);
} // namespace treacle
