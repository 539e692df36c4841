// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/transport/back_and_forth.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    Guesses
    cells_at(const Mesh<dim> &mesh, const std::vector<LocalIndex> &nodes)
    {
      Guesses guesses;
      for (const LocalIndex node : nodes)
        guesses.push_back(mesh.node_cells[mesh.node_cell_start[node]]);
      return guesses;
    }

    template <int dim>
    std::vector<double>
    traced(const Mesh<dim>                   &mesh,
           const std::vector<const Vector *> &fields,
           const VelocityInStep<dim>         &velocity,
           const double                       dt,
           const std::vector<LocalIndex>     &nodes)
    {
      std::vector<Point<dim>> x;
      for (const LocalIndex node : nodes)
        x.push_back(mesh.node_position[node]);
      std::vector<NodeField<dim>> node_fields;
      for (const Vector *field : fields)
        node_fields.push_back({field});
      const Tracer<dim> tracer(mesh);
      auto              guesses = cells_at(mesh, nodes);
      const auto        ends    = tracer.trace(x, velocity, dt, guesses);
      return tracer.evaluate(ends, node_fields, guesses);
    }
  } // namespace

  template <int dim>
  std::vector<Vector>
  back_and_forth_error(const Mesh<dim>                   &mesh,
                       const std::vector<const Vector *> &fields,
                       const VelocityInStep<dim>         &velocity,
                       const double                       dt,
                       const std::vector<LocalIndex>     &known,
                       const std::vector<LocalIndex>     &corrected)
  {
    const unsigned int  n      = fields.size();
    std::vector<double> values = traced<dim>(mesh, fields, velocity, -dt, known);
    std::vector<Vector>         carried(n, mesh.zeros(mesh.nodes));
    std::vector<const Vector *> carried_fields;
    for (unsigned int k = 0; k < n; ++k)
      {
        std::copy(fields[k]->begin(), fields[k]->end(), carried[k].begin());
        for (unsigned int i = 0; i < known.size(); ++i)
          carried[k].local_element(known[i]) = values[i * n + k];
        carried[k].update_ghost_values();
        carried_fields.push_back(&carried[k]);
      }

    values = traced<dim>(mesh, carried_fields, velocity, dt, corrected);
    std::vector<Vector> error(n, mesh.zeros(mesh.nodes));
    for (unsigned int k = 0; k < n; ++k)
      {
        for (unsigned int i = 0; i < corrected.size(); ++i)
          error[k].local_element(corrected[i]) =
            0.5 * (fields[k]->local_element(corrected[i]) - values[i * n + k]);
        error[k].update_ghost_values();
      }
    return error;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<Vector> back_and_forth_error(const Mesh<dim> &,         \
                                                    const std::vector<const Vector *> &, \
                                                    const VelocityInStep<dim> &, \
                                                    const double,              \
                                                    const std::vector<LocalIndex> &, \
                                                    const std::vector<LocalIndex> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
