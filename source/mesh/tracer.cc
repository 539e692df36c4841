// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/ask.h>
#include <treacle/mesh/last_location.h>
#include <treacle/mesh/tracer.h>

namespace treacle
{
  namespace
  {
    /// No cell contains it: what moved it there has gone wrong.
    template <int dim>
    void
    check_finite(const Point<dim> &x)
    {
      AssertThrow(std::isfinite(x.norm_square()),
                  ExcMessage("A point to be traced is not finite: " + to_text(x, 6) + "."));
    }

    /// Of the velocities at the stages of Ralston's method, which are at 0, 1/2 and 3/4 of the step.
    template <typename Velocity>
    Velocity
    mean_of_stages(const Velocity &first, const Velocity &second, const Velocity &third)
    {
      return (2. * first + 3. * second + 4. * third) * (1. / 9.);
    }

    /// In the order of the stages of paths forwards or backwards.
    template <int dim>
    std::array<const NodeVector<dim> *, 3>
    stages(const VelocityInStep<dim> &velocity, const double dt)
    {
      return {{&velocity.first(dt), velocity.after[2], velocity.after[dt < 0 ? 1 : 3]}};
    }
  } // namespace

  template <int dim>
  double
  Tracer<dim>::above_chord(const Location<dim> &location, const NodeField<dim> &field) const
  {
    const auto                         &nodes = mesh.cell_nodes[location.cell];
    std::array<Tensor<1, dim>, dim + 1> gradient;
    Tensor<1, dim>                      mean;
    double                              smoothness = 0;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        gradient[i] = field.gradient->value(nodes[i]);
        mean += location.lambda[i] * gradient[i];
        smoothness += location.lambda[i] * field.smoothness->local_element(nodes[i]);
      }
    const double square = mean.norm_square();
    double       above  = 0;
    for (unsigned int i = 0; i <= dim && square > 0; ++i)
      {
        const Tensor<1, dim> way = location.point - mesh.node_position[nodes[i]];
        above += 0.5 * location.lambda[i] * (gradient[i] * (way - (way * mean / square) * mean));
      }
    return smoothness * above;
  }

  template <int dim>
  void
  Tracer<dim>::evaluate_here(const Location<dim>               &location,
                             const std::vector<NodeField<dim>> &fields,
                             double                            *result) const
  {
    for (unsigned int k = 0; k < fields.size(); ++k)
      {
        const VertexValues<dim> f = mesh.values(location.cell, *fields[k].value);
        result[k]                 = interpolate(f, location.lambda);
        if (fields[k].correction != nullptr)
          {
            const VertexValues<dim> e = mesh.values(location.cell, *fields[k].correction);
            const auto [low, high]    = std::minmax_element(f.begin(), f.end());
            for (unsigned int i = 0; i <= dim; ++i)
              result[k] += location.lambda[i] * e[i];
            result[k] = std::clamp(result[k], *low, *high);
          }
        if (fields[k].gradient != nullptr && fields[k].is_distance)
          result[k] += above_chord(location, fields[k]);
        else if (fields[k].gradient != nullptr)
          {
            VertexValues<dim> weight = mesh.values(location.cell, *fields[k].smoothness);
            for (unsigned int i = 0; i <= dim; ++i)
              weight[i] *= location.lambda[i];
            result[k] += above_plane(mesh, mesh.cell_nodes[location.cell], weight, *fields[k].gradient);
          }
      }
  }

  template <int dim>
  std::vector<double>
  Tracer<dim>::evaluate(const std::vector<Point<dim>>     &x,
                        const std::vector<NodeField<dim>> &fields,
                        Guesses                           &guesses) const
  {
    const unsigned int        n = fields.size();
    std::vector<double>       values(x.size() * n);
    std::vector<unsigned int> elsewhere;
    LastLocation<dim>         last(mesh);
    guesses.resize(x.size(), invalid);
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const Location<dim> location = locator.locate(x[i], guesses[i] == invalid ? last.guess(x[i]) : guesses[i]);
        guesses[i]                   = location.cell;
        last.set(x[i], location.cell);
        if (location.cell == invalid)
          elsewhere.push_back(i);
        else
          evaluate_here(location, fields, &values[i * n]);
      }
    for (const unsigned int i : elsewhere)
      check_finite(x[i]);
    if (Utilities::MPI::n_mpi_processes(mesh.communicator()) > 1)
      evaluate_elsewhere(x, elsewhere, fields, values);
    return values;
  }

  template <int dim>
  void
  Tracer<dim>::evaluate_elsewhere(const std::vector<Point<dim>>     &x,
                                  const std::vector<unsigned int>   &elsewhere,
                                  const std::vector<NodeField<dim>> &fields,
                                  std::vector<double>               &values) const
  {
    const unsigned int        n = fields.size();
    std::vector<Point<dim>>   asked;
    std::vector<unsigned int> ranks;
    for (const unsigned int i : elsewhere)
      asked.push_back(x[i]);
    const auto owners = locator.owners_elsewhere(asked);
    for (unsigned int i = 0; i < owners.size(); ++i)
      {
        ranks.push_back(owners[i].rank);
        asked[i] = owners[i].point;
      }
    const std::vector<double> heard =
      ask(mesh.communicator(), ranks, asked, n, [&](const Point<dim> &p, double *result) {
        const Location<dim> location = locator.locate_here(p);
        AssertThrow(location.cell != invalid,
                    ExcMessage("There is no cell around the point " + to_text(p, 6) + "."));
        evaluate_here(location, fields, result);
      });
    for (unsigned int i = 0; i < elsewhere.size(); ++i)
      std::copy_n(&heard[i * n], n, &values[elsewhere[i] * n]);
  }

  template <int dim>
  std::vector<Point<dim>>
  Tracer<dim>::trace(const std::vector<Point<dim>>     &x,
                     const VelocityInStep<dim>         &velocity,
                     const double                       dt,
                     Guesses                           &guesses,
                     const std::vector<Tensor<1, dim>> &first) const
  {
    return locator.clamped(path_ends(x, velocity, dt, guesses, first));
  }

  template <int dim>
  std::optional<Tensor<1, dim>>
  Tracer<dim>::value_here(const Point<dim> &x, const NodeVector<dim> &field, LocalIndex &guess) const
  {
    const Location<dim> location = locator.locate(x, guess);
    guess                        = location.cell;
    if (location.cell == invalid)
      return {};
    Tensor<1, dim> value;
    for (unsigned int i = 0; i <= dim; ++i)
      value += location.lambda[i] * field.value(mesh.cell_nodes[location.cell][i]);
    return value;
  }

  template <int dim>
  std::optional<Point<dim>>
  Tracer<dim>::path_end_here(const Point<dim>                    &x,
                             const VelocityInStep<dim>           &velocity,
                             const double                         dt,
                             const std::optional<Tensor<1, dim>> &first,
                             LocalIndex                          &guess) const
  {
    if (dt == 0)
      return x;
    const auto v  = stages(velocity, dt);
    const auto k1 = first ? first : value_here(x, *v[0], guess);
    const auto k2 = k1 ? value_here(x + 0.5 * dt * *k1, *v[1], guess) : k1;
    const auto k3 = k2 ? value_here(x + 0.75 * dt * *k2, *v[2], guess) : k2;
    if (!k3)
      return {};
    return x + dt * mean_of_stages(*k1, *k2, *k3);
  }

  template <int dim>
  std::vector<Point<dim>>
  Tracer<dim>::path_ends(const std::vector<Point<dim>>     &x,
                         const VelocityInStep<dim>         &velocity,
                         const double                       dt,
                         Guesses                           &guesses,
                         const std::vector<Tensor<1, dim>> &first) const
  {
    guesses.resize(x.size(), invalid);
    std::vector<Point<dim>>       ends(x.size()), others;
    std::vector<unsigned int>     places;
    Guesses                       other_guesses;
    std::optional<Tensor<1, dim>> begin;
    LastLocation<dim>             last(mesh);
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        LocalIndex guess = guesses[i];
        if (guess == invalid)
          {
            guess = locator.locate(x[i], last.guess(x[i])).cell;
            last.set(x[i], guess);
          }
        if (!first.empty())
          begin = first[i];
        if (const auto end = path_end_here(x[i], velocity, dt, begin, guess))
          {
            ends[i]    = *end;
            guesses[i] = guess;
          }
        else
          {
            places.push_back(i);
            others.push_back(x[i]);
            other_guesses.push_back(guesses[i]);
          }
      }
    const auto other_ends = path_ends_anywhere(others, velocity, dt, other_guesses);
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        ends[places[i]]    = other_ends[i];
        guesses[places[i]] = other_guesses[i];
      }
    return ends;
  }

  template <int dim>
  std::vector<Point<dim>>
  Tracer<dim>::path_ends_anywhere(const std::vector<Point<dim>> &x,
                                  const VelocityInStep<dim>     &velocity,
                                  const double                   dt,
                                  Guesses                       &guesses) const
  {
    const auto v        = stages(velocity, dt);
    const auto advanced = [&](const std::vector<double> &k, const double step) {
      std::vector<Point<dim>> y = x;
      for (unsigned int i = 0; i < x.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          y[i][d] += step * k[i * dim + d];
      return y;
    };
    const std::vector<double> k1 = evaluate(x, fields_of(*v[0]), guesses);
    const std::vector<double> k2 = evaluate(advanced(k1, 0.5 * dt), fields_of(*v[1]), guesses);
    const std::vector<double> k3 = evaluate(advanced(k2, 0.75 * dt), fields_of(*v[2]), guesses);
    std::vector<double>       k(k1.size());
    for (unsigned int i = 0; i < k.size(); ++i)
      k[i] = mean_of_stages(k1[i], k2[i], k3[i]);
    return advanced(k, dt);
  }

  template class Tracer<2>;
  template class Tracer<3>;
} // namespace treacle
