// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/tracer.h>

namespace treacle
{
  template <int dim>
  void
  Tracer<dim>::evaluate_here(const Location<dim>               &location,
                             const Point<dim>                  &x,
                             const std::vector<NodeField<dim>> &fields,
                             double                            *result) const
  {
    const auto &nodes = mesh.cell_nodes[location.cell];
    for (unsigned int k = 0; k < fields.size(); ++k)
      {
        const VertexValues<dim> f = mesh.values(location.cell, *fields[k].value);
        result[k]                 = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          result[k] += location.lambda[i] * f[i];
        if (fields[k].correction != nullptr)
          {
            const VertexValues<dim> e = mesh.values(location.cell, *fields[k].correction);
            const auto [low, high]    = std::minmax_element(f.begin(), f.end());
            for (unsigned int i = 0; i <= dim; ++i)
              result[k] += location.lambda[i] * e[i];
            result[k] = std::clamp(result[k], *low, *high);
          }
        if (fields[k].gradient == nullptr)
          continue;
        double correction = 0, smoothness = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            const Tensor<1, dim> g = fields[k].gradient->value(nodes[i]);
            correction += 0.5 * location.lambda[i] * (g * (x - mesh.node_position[nodes[i]]));
            smoothness += location.lambda[i] * fields[k].smoothness->local_element(nodes[i]);
          }
        result[k] += smoothness * correction;
      }
  }

  template <int dim>
  std::vector<double>
  Tracer<dim>::evaluate(const std::vector<Point<dim>>     &x,
                        const std::vector<NodeField<dim>> &fields) const
  {
    const unsigned int        n = fields.size();
    std::vector<double>       values(x.size() * n);
    std::vector<unsigned int> elsewhere;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const Location<dim> location = locator.locate(x[i]);
        if (location.cell == invalid)
          elsewhere.push_back(i);
        else
          evaluate_here(location, locator.clamped(x[i]), fields, &values[i * n]);
      }
    const MPI_Comm    &comm    = mesh.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return values;

    std::vector<Point<dim>> asked;
    for (const unsigned int i : elsewhere)
      asked.push_back(locator.clamped(x[i]));
    const std::vector<unsigned int>    owner = mesh.octree().owner_ranks(asked);
    PerRank<std::array<double, dim>>   questions(n_ranks);
    for (unsigned int i = 0; i < asked.size(); ++i)
      {
        std::array<double, dim> p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = asked[i][d];
        questions[owner[i]].push_back(p);
      }
    const auto      received = send_and_receive(comm, questions);
    PerRank<double> answers(n_ranks);
    for (unsigned int r = 0; r < n_ranks; ++r)
      {
        answers[r].resize(received[r].size() * n);
        for (unsigned int i = 0; i < received[r].size(); ++i)
          {
            Point<dim> p;
            for (unsigned int d = 0; d < dim; ++d)
              p[d] = received[r][i][d];
            const Location<dim> location = locator.locate(p);
            AssertThrow(location.cell != invalid, ExcInternalError());
            evaluate_here(location, p, fields, &answers[r][i * n]);
          }
      }
    const auto                heard = send_and_receive(comm, answers);
    std::vector<unsigned int> next(n_ranks, 0);
    for (unsigned int i = 0; i < elsewhere.size(); ++i)
      for (unsigned int k = 0; k < n; ++k)
        values[elsewhere[i] * n + k] = heard[owner[i]][next[owner[i]]++];
    return values;
  }

  template <int dim>
  std::vector<Point<dim>>
  Tracer<dim>::trace(const std::vector<Point<dim>> &x,
                     const NodeVector<dim>         &velocity,
                     const double                   dt) const
  {
    std::vector<NodeField<dim>> fields;
    for (const Vector &component : velocity.component)
      fields.push_back({&component});
    const auto advanced = [&](const std::vector<double> &k, const double step) {
      std::vector<Point<dim>> y = x;
      for (unsigned int i = 0; i < x.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          y[i][d] += step * k[i * dim + d];
      return y;
    };
    const std::vector<double> k1 = evaluate(x, fields);
    const std::vector<double> k2 = evaluate(advanced(k1, 0.5 * dt), fields);
    const std::vector<double> k3 = evaluate(advanced(k2, 0.75 * dt), fields);
    std::vector<double>       k(k1.size());
    for (unsigned int i = 0; i < k.size(); ++i)
      k[i] = (2 * k1[i] + 3 * k2[i] + 4 * k3[i]) / 9;
    std::vector<Point<dim>> y = advanced(k, dt);
    for (Point<dim> &p : y)
      p = locator.clamped(p);
    return y;
  }

  template class Tracer<2>;
  template class Tracer<3>;
} // namespace treacle
