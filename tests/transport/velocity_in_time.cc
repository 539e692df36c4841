// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// The velocity in a step of a stream that carries waves of six leaves along, 2.7 leaves a step, and of a body that turns by 0.2, with
// a shorter step before it: after each quarter the waves are where the stream has carried them, but for what P1
// functions show of them, and the body turns as fast as it did.

#include <treacle/transport/velocity_in_time.h>

#include "../body.h"

namespace tests::transport_velocity_in_time
{
  namespace
  {
    constexpr double part_before = 0.6; // of the step, that the one before took

    template <int dim>
    using Velocity = std::function<Tensor<1, dim>(const Point<dim> &, const double)>;

    /// Where what is at x at t = 0 was a time before.
    template <int dim>
    Point<dim>
    origin(Point<dim> x, const double time, const Velocity<dim> &velocity)
    {
      constexpr unsigned int n = 50;
      for (unsigned int k = 0; k < n; ++k)
        {
          const Point<dim> middle = x - 0.5 * time / n * velocity(x, -k * time / n);
          x -= time / n * velocity(middle, -(k + 0.5) * time / n);
        }
      return x;
    }

    /// The largest error (m/s) after each quarter of a step, half a box wide, where nodes know what their liquid had before, and where they do not.
    template <int dim>
    std::array<double, 4>
    largest_errors(Body<dim> &body, const double dt, const Velocity<dim> &velocity, const bool nodes_know)
    {
      const Mesh<dim> &mesh     = *body.state.mesh;
      const auto       at_nodes = [&](const double t) {
        NodeVector<dim> v(mesh.nodes);
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          v.set(node, velocity(mesh.node_position[node], t));
        v.update_ghost_values();
        return v;
      };
      for (unsigned int d = 0; d < dim; ++d)
        body.state.v.component[d] = at_nodes(0).component[d];
      body.state.v.update_ghost_values();
      NodeVector<dim> along(mesh.nodes, std::numeric_limits<double>::quiet_NaN());
      if (nodes_know)
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          along.set(node, velocity(origin(mesh.node_position[node], part_before * dt, velocity), -part_before * dt));
      along.update_ghost_values();
      body.state.before.emplace(VelocityBefore<dim>{part_before * dt, at_nodes(-part_before * dt), std::move(along), {}});
      const StepVelocity<dim> v =
        velocity_in_step<dim>(body.state, body.domain, BackwardDifference(dt, body.state), 1, [](const NodeVector<dim> &of) {
          return combined(1, of, 0, of);
        });
      std::array<double, 4> error{};
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (const Point<dim> &x = mesh.node_position[node];
            (x - diagonal_point<dim>(0.5)).norm() < 0.25)
          for (const unsigned int part : {1, 2, 3, 4})
            for (const auto &at : {v.carried[part], v.surface[part]})
              error[part - 1] = std::max(error[part - 1], (at.value(node) - velocity(x, 0.25 * part * dt)).norm());
      for (double &e : error)
        e = Utilities::MPI::max(e, mesh.communicator());
      return error;
    }

    template <int dim>
    void
    report(Body<dim> &body, const std::string &what, const double dt, const Velocity<dim> &velocity, const std::array<double, 4> &bound)
    {
      for (const bool nodes_know : {false, true})
        {
          const auto error = largest_errors<dim>(body, dt, velocity, nodes_know);
          out() << dim << "D, " << what << (nodes_know ? ", before known" : "") << ": error after each quarter";
          for (const unsigned int i : {0, 1, 2, 3})
            out() << (error[i] < bound[i] ? " below " + digits(bound[i]) : " TOO LARGE, " + digits(error[i]));
          out() << std::endl;
        }
    }

    template <int dim>
    void
    check(const MPI_Comm &comm, const unsigned int level)
    {
      const std::string l = std::to_string(level);
      Body<dim>         body(comm,
                     "subsection Mesh\nset Surface level = " + l + "\nset Interior level = " + l + "\nset Air level = " + l +
                       "\nend\nsubsection Liquid 1\nset Radius = 0.45\nend\n");
      const double h = body.state.mesh->finest_size(), k = 2 * numbers::PI / (6 * h);
      // of P1 functions: (k h)^2 / 8 = 0.14 between two nodes; continued at the nodes themselves the error is 0.018 and 0.041
      report<dim>(
        body,
        "waves on a stream",
        2.7 * h,
        [&](const Point<dim> &x, const double t) {
          Tensor<1, dim> v;
          v[0]       = 1;
          v[dim - 1] = 0.01 * std::sin(k * (x[0] - t));
          return v;
        },
        {{0.002, 0.003, 0.005, 0.006}});
      report<dim>(
        body,
        "a body that turns",
        0.2,
        [&](const Point<dim> &x, const double) {
          Tensor<1, dim> v;
          v[0] = -(x[1] - 0.5);
          v[1] = x[0] - 0.5;
          return v;
        },
        {{2e-5, 1e-5, 1e-4, 1e-4}});
    }

    void
    test(const int, char **)
    {
      on_1_2_3_ranks([](const MPI_Comm &comm) {
        check<2>(comm, 5);
        check<3>(comm, 4);
      });
    }
  } // namespace

  const Test registered("transport/velocity_in_time", test);
} // namespace tests::transport_velocity_in_time
