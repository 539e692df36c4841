// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_tracer_h
#define treacle_mesh_tracer_h

#include <treacle/mesh/locator.h>

#include <array>
#include <optional>

namespace treacle
{
  /// For each point the cell of this rank where it is looked for first, then that where it was
  /// found; invalid where none is known. Empty: none are known.
  using Guesses = std::vector<LocalIndex>;

  /// A node field, P1 in a cell. With nodal gradients g (1/m) and their smoothness s
  /// (1 where the field has one, 0 at kinks) it is a distance, evaluated as
  /// `sum lambda_i f_i + (sum lambda_i s_i) sum lambda_i g_i·P(x - x_i)/2`, P across
  /// `sum lambda_i g_i`: continuous, and exact for distances from curved surfaces but for terms of
  /// higher order where s = 1. Along its gradient a distance is linear; what is not, as where the velocity that
  /// moved it has a kink, is an error that the surface between two nodes does not show. What is no distance bends in all directions
  /// between nodes that have a smoothness, by `1/2 sum_(i<j) s_i s_j lambda_i lambda_j (g_i - g_j)·(x_j - x_i)`: continuous, linear where g is
  /// the same, quadratic where it is linear. With a correction e it is f + e, limited to the values of f at the nodes of the cell.
  template <int dim>
  struct NodeField
  {
    const Vector          *value;
    const NodeVector<dim> *gradient   = nullptr;
    const Vector          *smoothness = nullptr;
    const Vector          *correction = nullptr;
    bool                   is_distance = true;
  };

  /// By how much a field that is no distance bends away from the mean of some nodes of a cell, with their @p weight s lambda.
  template <int dim, std::size_t n>
  double
  above_plane(const Mesh<dim>                  &mesh,
              const std::array<LocalIndex, n> &nodes,
              const std::array<double, n>     &weight,
              const NodeVector<dim>           &gradient)
  {
    std::array<Tensor<1, dim>, n> g;
    for (unsigned int i = 0; i < n; ++i)
      g[i] = gradient.value(nodes[i]);
    double above = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < i; ++j)
        above += weight[i] * weight[j] * ((g[i] - g[j]) * (mesh.node_position[nodes[j]] - mesh.node_position[nodes[i]]));
    return above / 2;
  }

  /// Its components.
  template <int dim>
  std::vector<NodeField<dim>>
  fields_of(const NodeVector<dim> &v)
  {
    std::vector<NodeField<dim>> fields;
    for (const Vector &component : v.component)
      fields.push_back({&component});
    return fields;
  }

  /// The velocity of nodes at the begin of a step, after each quarter of it, at its end; each of them stays
  /// as it is. Is not an owner.
  template <int dim>
  struct VelocityInStep
  {
    std::array<const NodeVector<dim> *, 5> after;

    VelocityInStep(const NodeVector<dim> &steady)
    {
      after.fill(&steady);
    }

    VelocityInStep(const std::array<NodeVector<dim>, 5> &v)
      : after{{&v[0], &v[1], &v[2], &v[3], &v[4]}}
    {}

    /// Where paths of a step of size @p dt begin, forwards, or backwards where that is negative.
    const NodeVector<dim> &
    first(const double dt) const
    {
      return *after[dt < 0 ? 4 : 0];
    }
  };

  /// Follows paths and evaluates node fields anywhere in the mesh: what lies on
  /// another rank is asked of that rank. All members are collective, and all
  /// vectors must have up-to-date ghosts.
  template <int dim>
  class Tracer
  {
  public:
    explicit Tracer(const Mesh<dim> &mesh)
      : mesh(mesh)
      , locator(mesh.locator())
    {}

    /// Values of n fields at each point: [point * n + field]. Points outside
    /// of the mesh are moved to it.
    std::vector<double>
    evaluate(const std::vector<Point<dim>>     &x,
             const std::vector<NodeField<dim>> &fields,
             Guesses                           &guesses) const;

    std::vector<double>
    evaluate(const std::vector<Point<dim>> &x, const std::vector<NodeField<dim>> &fields) const
    {
      Guesses none;
      return evaluate(x, fields, none);
    }

    /// Where the paths through @p x lead in a step of size @p dt, with Ralston's Runge-Kutta method of order 3. Negative: where
    /// those that end in x come from. Paths that leave the mesh end at its boundary. Guesses are for x, then for the ends. Who
    /// knows it gives the velocity that paths begin with, velocity.first(dt) at x (m/s), which saves to look for x.
    std::vector<Point<dim>>
    trace(const std::vector<Point<dim>>     &x,
          const VelocityInStep<dim>         &velocity,
          const double                       dt,
          Guesses                           &guesses,
          const std::vector<Tensor<1, dim>> &first = {}) const;

    std::vector<Point<dim>>
    trace(const std::vector<Point<dim>> &x, const VelocityInStep<dim> &velocity, const double dt) const
    {
      Guesses none;
      return trace(x, velocity, dt, none);
    }

    /// The same, but paths may end outside of the mesh.
    std::vector<Point<dim>>
    path_ends(const std::vector<Point<dim>>     &x,
              const VelocityInStep<dim>         &velocity,
              const double                       dt,
              Guesses                           &guesses,
              const std::vector<Tensor<1, dim>> &first = {}) const;

  private:
    /// Not collective; nothing where the point may lie on another rank. Guesses become where it was found.
    std::optional<Tensor<1, dim>>
    value_here(const Point<dim> &x, const NodeVector<dim> &field, LocalIndex &guess) const;

    /// The same of a path, with the velocity that it begins with. One after the other they stay among the same few cells.
    std::optional<Point<dim>>
    path_end_here(const Point<dim>                    &x,
                  const VelocityInStep<dim>           &velocity,
                  const double                         dt,
                  const std::optional<Tensor<1, dim>> &first,
                  LocalIndex                          &guess) const;

    /// Paths that lead to other ranks or out of the mesh.
    std::vector<Point<dim>>
    path_ends_anywhere(const std::vector<Point<dim>> &x,
                       const VelocityInStep<dim>     &velocity,
                       const double                   dt,
                       Guesses                       &guesses) const;

    /// Those of some points that are not found here.
    void
    evaluate_elsewhere(const std::vector<Point<dim>>     &x,
                       const std::vector<unsigned int>   &elsewhere,
                       const std::vector<NodeField<dim>> &fields,
                       std::vector<double>               &values) const;

    /// What the nodal gradients of a distance add to the mean of its nodes.
    double
    above_chord(const Location<dim> &location, const NodeField<dim> &field) const;

    void
    evaluate_here(const Location<dim>               &location,
                  const std::vector<NodeField<dim>> &fields,
                  double                            *result) const;

    const Mesh<dim>    &mesh;
    const Locator<dim> &locator;
  };
} // namespace treacle

#endif
