// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/tracer.h>
#include <treacle/transport/velocity_in_time.h>

namespace treacle
{
  namespace
  {
    /// Owned nodes that liquid may pass, and a cell of each.
    template <int dim>
    struct PassedNodes
    {
      const Mesh<dim>        &mesh;
      std::vector<LocalIndex> nodes;
      std::vector<Point<dim>> x;
      Guesses                 cells;

      explicit PassedNodes(const Mesh<dim> &mesh)
        : mesh(mesh)
      {}

      PassedNodes(const State<dim> &state, const double reach)
        : PassedNodes(*state.mesh)
      {
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          if (state.phi.local_element(node) < reach)
            add(node);
      }

      void
      add(const LocalIndex node)
      {
        nodes.push_back(node);
        x.push_back(mesh.node_position[node]);
        cells.push_back(mesh.node_cells[mesh.node_cell_start[node]]);
      }

      std::vector<Tensor<1, dim>>
      values(const NodeVector<dim> &v) const
      {
        std::vector<Tensor<1, dim>> result;
        result.reserve(nodes.size());
        for (const LocalIndex node : nodes)
          result.push_back(v.value(node));
        return result;
      }
    };

    /// A velocity now and how it changes; components that are held do so at the node.
    template <int dim>
    struct Changing
    {
      const NodeVector<dim>            &now;
      NodeVector<dim>                   change; ///< in the step before, of what is at each node now (m/s)
      const std::vector<unsigned char> &held;

      /// Where it is the liquid's, nodes may remember what that had before.
      Changing(const NodeVector<dim>            &now,
               const NodeVector<dim>            &before,
               const State<dim>                 &state,
               const PassedNodes<dim>           &passed,
               const std::vector<unsigned char> &held)
        : now(now)
        , change(combined(1, now, -1, before))
        , held(held)
      {
        const NodeVector<dim> &along   = *state.before->v_along;
        const NodeVector<dim>  between = combined(0.5, now, 0.5, before);
        const auto             knows   = [&](const LocalIndex node) {
          return state.before->remembers(node) && now.value(node) == state.v.value(node);
        };
        PassedNodes<dim> known(passed.mesh), unknown(passed.mesh);
        for (unsigned int i = 0; i < passed.nodes.size(); ++i)
          (knows(passed.nodes[i]) ? known : unknown).add(passed.nodes[i]);
        const Tracer<dim>         tracer(passed.mesh);
        Guesses                   cells = unknown.cells;
        const auto from = tracer.trace(unknown.x, between, -state.before->dt, cells, unknown.values(between));
        const std::vector<double> values = tracer.evaluate(from, fields_of(before), cells);
        set(unknown, change, [&](const unsigned int i, const unsigned int d) {
          return now.component[d].local_element(unknown.nodes[i]) - values[dim * i + d];
        });
        set(known, change, [&](const unsigned int i, const unsigned int d) {
          return now.component[d].local_element(known.nodes[i]) - along.component[d].local_element(known.nodes[i]);
        });
      }

      /// @p v at the passed nodes to value (number, component), but for what is held.
      template <typename Value>
      void
      set(const PassedNodes<dim> &passed, NodeVector<dim> &v, const Value &value) const
      {
        for (unsigned int i = 0; i < passed.nodes.size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            if (!(held[passed.nodes[i]] >> d & 1))
              v.component[d].local_element(passed.nodes[i]) = value(i, d);
        v.update_ghost_values();
      }
    };

    template <int dim>
    std::vector<NodeField<dim>>
    fields_of(const NodeVector<dim> &v, const NodeVector<dim> &w)
    {
      auto       fields = fields_of(v);
      const auto more   = fields_of(w);
      fields.insert(fields.end(), more.begin(), more.end());
      return fields;
    }

    /// With ghosts, which deal.II does not copy.
    template <int dim>
    NodeVector<dim>
    copy(const NodeVector<dim> &v)
    {
      return combined(1, v, 0, v);
    }

    /// What stays as it is.
    template <int dim>
    std::array<NodeVector<dim>, 5>
    steady(const NodeVector<dim> &v)
    {
      return {{copy(v), copy(v), copy(v), copy(v), copy(v)}};
    }

    /// After each quarter, quadratic in time.
    template <int dim>
    std::array<NodeVector<dim>, 5>
    quarters(const NodeVector<dim> &begin, const NodeVector<dim> &middle, const NodeVector<dim> &end)
    {
      const auto between = [&](const NodeVector<dim> &near, const NodeVector<dim> &far) {
        return combined(1, combined(0.375, near, 0.75, middle), -0.125, far);
      };
      return {{copy(begin), between(begin, end), copy(middle), between(end, begin), copy(end)}};
    }
  } // namespace

  template <int dim>
  StepVelocity<dim>
  velocity_in_step(const State<dim>             &state,
                   const LiquidDomain<dim>      &domain,
                   const BackwardDifference     &difference,
                   const double                  reach,
                   const SurfaceVelocityOf<dim> &of_surface)
  {
    const NodeVector<dim> surface = of_surface(state.v);
    if (difference.before == 0)
      return {steady(state.v), steady(surface)};
    const NodeVector<dim>           &before = *state.before->v;
    const double                     dt     = state.before->dt;
    const std::vector<unsigned char> none(domain.constrained.size());
    const PassedNodes<dim>            passed(state, reach);
    const Changing<dim>               liquid(state.v, before, state, passed, domain.constrained);
    const Changing<dim>               moving_surface(surface, of_surface(before), state, passed, none);
    const Tracer<dim>                 tracer(*state.mesh);
    const std::vector<Tensor<1, dim>> first = passed.values(surface);
    std::vector<NodeVector<dim>>      carried, moving; // in the middle and at the end
    for (const unsigned int half : {1, 2})
      {
        const double after = 0.5 * half * difference.dt;
        Guesses      here = passed.cells, there = passed.cells;
        const auto   y       = tracer.trace(passed.x, surface, -after, here, first);
        const auto   z       = tracer.trace(passed.x, surface, 0.5 * (dt - after), there, first);
        const auto   values  = tracer.evaluate(y, fields_of(state.v, surface), here);
        const auto   changes = tracer.evaluate(z, fields_of(liquid.change, moving_surface.change), there);
        const auto   continued = [&](const Changing<dim> &changing, const unsigned int offset) {
          NodeVector<dim> v = combined(1, changing.now, after / dt, changing.change);
          changing.set(passed, v, [&](const unsigned int i, const unsigned int d) {
            const unsigned int k = 2 * dim * i + offset + d;
            return values[k] + after / dt * changes[k];
          });
          return v;
        };
        carried.push_back(continued(liquid, 0));
        moving.push_back(continued(moving_surface, dim));
      }
    return {quarters(state.v, carried[0], carried[1]), quarters(surface, moving[0], moving[1])};
  }

#define INSTANTIATE(dim)                                                  \
  template StepVelocity<dim> velocity_in_step(const State<dim> &,         \
                                              const LiquidDomain<dim> &,  \
                                              const BackwardDifference &, \
                                              const double,               \
                                              const SurfaceVelocityOf<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
