// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/viscosity/reactions.h>

namespace treacle
{
  Tensor<1, 1>
  moment(const Tensor<1, 2> &arm, const Tensor<1, 2> &force)
  {
    Tensor<1, 1> result;
    result[0] = arm[0] * force[1] - arm[1] * force[0];
    return result;
  }

  Tensor<1, 3>
  moment(const Tensor<1, 3> &arm, const Tensor<1, 3> &force)
  {
    return cross_product_3d(arm, force);
  }

  namespace
  {
    template <int dim>
    Tensor<2, dim>
    stress(const typename NodeSystem<dim>::Stiffness &stiffness,
           const LocalIndex                           cell,
           const Tensor<2, dim>                      &grad)
    {
      Tensor<2, dim> result;
      if (!stiffness.strain.empty())
        {
          result += stiffness.strain[cell] * (grad + transpose(grad));
          if (stiffness.skin.has(cell))
            result += 2 * stiffness.strain[cell] * stiffness.skin.stress(cell, grad);
          if (stiffness.kinks.has(cell))
            result += stiffness.kinks.stress(cell, grad);
        }
      if (!stiffness.gradient.empty())
        result += stiffness.gradient[cell] * grad;
      return result;
    }
  } // namespace

  template <int dim>
  Reactions<dim>::Reactions(const LiquidDomain<dim> &domain, const double time)
    : domain(domain)
    , time(time)
    , sums(domain.scene.n_solids() + 1)
  {
    for (unsigned int k = 0; k < domain.scene.n_solids(); ++k)
      centre.push_back(domain.scene.solid_centre(k, time));
    centre.push_back(domain.mesh.middle());
  }

  template <int dim>
  void
  Reactions<dim>::add_stress(const typename NodeSystem<dim>::Stiffness &stiffness,
                             const NodeVector<dim>                     &v,
                             const double                               factor)
  {
    const Mesh<dim> &mesh = domain.mesh;
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      {
        const auto &nodes = mesh.cell_nodes[c];
        if (domain.is_active_cell[c] && domain.cut_cells.parts(c).size() > 0)
          {
            add_stress_of_parts(stiffness, v, factor, c);
            continue;
          }
        if (!domain.is_active_cell[c] || std::all_of(nodes.begin(), nodes.end(), [&](LocalIndex n) {
              return n >= mesh.n_owned_nodes() || domain.constrained[n] == 0;
            }))
          continue;
        const auto          &g     = mesh.cell_gradients[c];
        const Tensor<2, dim> sigma = stress<dim>(stiffness, c, velocity_gradient(mesh, c, v));
        for (unsigned int i = 0; i <= dim; ++i)
          if (nodes[i] < mesh.n_owned_nodes())
            add_at_node(nodes[i], factor * (sigma * g[i]));
      }
  }

  template <int dim>
  void
  Reactions<dim>::add_stress_of_parts(const typename NodeSystem<dim>::Stiffness &stiffness,
                                      const NodeVector<dim>                     &v,
                                      const double                               factor,
                                      const LocalIndex                           c)
  {
    const Mesh<dim> &mesh    = domain.mesh;
    const auto      &nodes   = mesh.cell_nodes[c];
    const LocalIndex deepest = *std::min_element(nodes.begin(), nodes.end(), [&](LocalIndex a, LocalIndex b) {
      return domain.solid_distance[a] < domain.solid_distance[b];
    });
    for (const auto &part : domain.cut_cells.parts(c))
      {
        const Tensor<2, dim> sigma = stress<dim>(stiffness, c, part.velocity_gradient(nodes, v));
        for (unsigned int k = 0; k <= dim; ++k)
          if (part.vertex[k] != CutCells<dim>::on_wall)
            {
              const LocalIndex     node    = nodes[part.vertex[k]];
              const Tensor<1, dim> impulse = factor * part.fraction * (sigma * part.gradient[k]);
              if (node < mesh.n_owned_nodes())
                add_at_node(node, impulse);
              // forces and, as stress is symmetric, moments of a part sum to zero: the wall's
              // are those of the other nodes turned round
              if (c < mesh.n_owned_cells())
                {
                  add(body_of_node(deepest), mesh.node_position[node], -impulse);
                  work -= impulse * domain.prescribed[deepest];
                }
            }
      }
  }

  template <int dim>
  void
  Reactions<dim>::add_inertia(const NodeSystem<dim> &system,
                              const Vector          &before,
                              const Vector          &after)
  {
    const auto momentum_before = system.face_momentum(before);
    const auto momentum_after  = system.face_momentum(after);
    for (LocalIndex node = 0; node < domain.mesh.n_owned_nodes(); ++node)
      if (domain.is_active_node[node])
        add_at_node(node, momentum_after[node] - momentum_before[node]);
  }

  template <int dim>
  void
  Reactions<dim>::add_pressure(const Vector &pressure, const double step)
  {
    const Mesh<dim> &mesh = domain.mesh;
    for (const auto &[c, excess] : domain.closed_excess)
      if (c < mesh.n_owned_cells())
        work -= step * pressure.local_element(c) * excess;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      {
        const LocalIndex beyond = mesh.face_cells[f][1];
        const double     jump   = pressure.local_element(mesh.face_cells[f][0]) -
                            (beyond == invalid ? 0. : pressure.local_element(beyond));
        if (domain.open_fraction[f] == 1 || jump == 0)
          continue;
        const Tensor<1, dim> impulse = -step * jump * mesh.face_area[f] * mesh.face_normal[f];
        work -= step * jump * mesh.face_area[f] * (1 - domain.open_fraction[f]) * domain.solid_velocity[f];
        std::array<Point<dim>, dim> x;
        VertexValues<dim - 1>       held;
        for (unsigned int i = 0; i < dim; ++i)
          {
            const LocalIndex node = mesh.face_nodes[f][i];
            x[i]                  = mesh.node_position[node];
            held[i]               = domain.held_distance[node];
          }
        const bool   is_wall = mesh.face_side[f] != Mesh<dim>::no_side;
        const double part =
          is_wall ? negative_fraction<dim - 1>(held) : 1 - domain.open_fraction[f];
        const Point<dim> held_centre = negative_centroid<dim>(x, held);
        if (part > 0)
          add(holder(held_centre), held_centre, part * impulse);
        if (is_wall && part < 1)
          add(domain.scene.n_solids(),
              Point<dim>((mesh.face_centre(f) - part * held_centre) / (1 - part)),
              (1 - part) * impulse);
      }
  }

  template <int dim>
  std::vector<Load<dim>>
  Reactions<dim>::loads(const double step) const
  {
    std::vector<Load<dim>> result = sums;
    for (Load<dim> &load : result)
      {
        load.force  = -Utilities::MPI::sum(load.force, domain.mesh.communicator()) / step;
        load.torque = -Utilities::MPI::sum(load.torque, domain.mesh.communicator()) / step;
      }
    return result;
  }

  template <int dim>
  double
  Reactions<dim>::power(const double step) const
  {
    return Utilities::MPI::sum(work, domain.mesh.communicator()) / step;
  }

  template <int dim>
  unsigned int
  Reactions<dim>::body_of_node(const LocalIndex node) const
  {
    return domain.solid_distance[node] <= 0 ?
             domain.scene.nearest_solid(domain.mesh.node_position[node], time) :
           domain.is_emitter_node[node] ? none :
                                          domain.scene.n_solids();
  }

  template <int dim>
  unsigned int
  Reactions<dim>::holder(const Point<dim> &x) const
  {
    return !domain.emitters_rest && domain.scene.is_emitter_nearest(x, time) ? none : domain.scene.nearest_solid(x, time);
  }

  template <int dim>
  void
  Reactions<dim>::add_at_node(const LocalIndex node, const Tensor<1, dim> &impulse)
  {
    if (domain.constrained[node] == 0)
      return;
    Tensor<1, dim> prescribed;
    for (unsigned int d = 0; d < dim; ++d)
      if (domain.constrained[node] >> d & 1)
        prescribed[d] = impulse[d];
    add(body_of_node(node), domain.mesh.node_position[node], prescribed);
    work += prescribed * domain.prescribed[node];
  }

  template <int dim>
  void
  Reactions<dim>::add(const unsigned int    body,
                      const Point<dim>     &x,
                      const Tensor<1, dim> &impulse)
  {
    if (body == none)
      return;
    sums[body].force += impulse;
    sums[body].torque += moment(x - centre[body], impulse);
  }

  template class Reactions<2>;
  template class Reactions<3>;
} // namespace treacle
