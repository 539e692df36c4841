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

      PassedNodes(const State<dim> &state, const double reach)
        : mesh(*state.mesh)
      {
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          if (state.phi.local_element(node) < reach)
            {
              nodes.push_back(node);
              x.push_back(mesh.node_position[node]);
              cells.push_back(mesh.node_cells[mesh.node_cell_start[node]]);
            }
      }

      /// Values at these, [node * dim + component], of the components of @p v that are not held.
      void
      copy_to(NodeVector<dim>                  &v,
              const std::vector<double>        &values,
              const std::vector<unsigned char> &held) const
      {
        for (unsigned int i = 0; i < nodes.size(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            if (!(held[nodes[i]] >> d & 1))
              v.component[d].local_element(nodes[i]) = values[dim * i + d];
        v.update_ghost_values();
      }
    };

    /// How much the velocity of what is at each node now has changed in the step before, of size @p dt (m/s); of components that
    /// are held, at the node.
    template <int dim>
    NodeVector<dim>
    change_along_paths(const NodeVector<dim>            &now,
                       const NodeVector<dim>            &before,
                       const double                      dt,
                       const PassedNodes<dim>           &passed,
                       const std::vector<unsigned char> &held)
    {
      const Tracer<dim> tracer(passed.mesh);
      Guesses           cells  = passed.cells;
      const auto        from   = tracer.trace(passed.x, combined(0.5, now, 0.5, before), -dt, cells);
      auto              values = tracer.evaluate(from, fields_of(before), cells);
      for (unsigned int i = 0; i < passed.nodes.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          values[dim * i + d] = now.component[d].local_element(passed.nodes[i]) - values[dim * i + d];
      NodeVector<dim> change = combined(1, now, -1, before);
      passed.copy_to(change, values, held);
      return change;
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
    const PassedNodes<dim>           passed(state, reach);
    const NodeVector<dim> change = change_along_paths(state.v, before, dt, passed, domain.constrained);
    const NodeVector<dim> change_of_surface =
      change_along_paths(surface, of_surface(before), dt, passed, none);
    const Tracer<dim>            tracer(*state.mesh);
    std::vector<NodeVector<dim>> carried, moving; // in the middle and at the end
    for (const unsigned int half : {1, 2})
      {
        const double after     = 0.5 * half * difference.dt;
        Guesses      here      = passed.cells, there = passed.cells;
        const auto   y         = tracer.trace(passed.x, surface, -after, here);
        const auto   z         = tracer.trace(passed.x, surface, 0.5 * (dt - after), there);
        const auto   continued = [&](const NodeVector<dim>            &now,
                                   const NodeVector<dim>            &change,
                                   const std::vector<unsigned char> &held) {
          auto       values  = tracer.evaluate(y, fields_of(now), here);
          const auto changes = tracer.evaluate(z, fields_of(change), there);
          for (unsigned int i = 0; i < values.size(); ++i)
            values[i] += after / dt * changes[i];
          NodeVector<dim> v = combined(1, now, after / dt, change);
          passed.copy_to(v, values, held);
          return v;
        };
        carried.push_back(continued(state.v, change, domain.constrained));
        moving.push_back(continued(surface, change_of_surface, none));
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
