// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// What flows through the surface of a disc or ball that turns, moves, and swells beside
// its surface alone, and through that of a layer that rises from a wall: hardly any once
// the divergence beside the surface is taken out. A rigid motion stays as it is, what the
// wall prescribes too, and nothing leaves half a disc or ball through the wall it lies on. Two halves go on to close a gap thinner than a leaf. A thread thinner than a
// leaf, which the lattice shows as drops in a row, becomes thinner as it is stretched.

#include <treacle/fields/gradients.h>
#include <treacle/transport/surface_divergence.h>
#include <treacle/transport/velocity_in_time.h>

#include "../body.h"

namespace tests::transport_surface_divergence
{
  namespace
  {
    template <int dim>
    using Velocity = std::function<Tensor<1, dim>(const LocalIndex)>;

    template <int dim>
    NodeVector<dim>
    at_nodes(const Mesh<dim> &mesh, const Velocity<dim> &velocity)
    {
      NodeVector<dim> v(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        v.set(node, velocity(node));
      v.update_ghost_values();
      return v;
    }

    template <int dim>
    void
    remove_divergence(const State<dim>        &state,
                      const LiquidDomain<dim> &domain,
                      NodeVector<dim>         &v)
    {
      SurfaceDivergence<dim>(state, nodal_gradient(*state.mesh, state.phi), domain).remove_from(v);
    }

    std::string
    uniform_mesh(const unsigned int level)
    {
      const std::string l = std::to_string(level);
      return "subsection Mesh\nset Surface level = " + l + "\nset Interior level = " + l + "\nset Air level = " + l + "\nend\n";
    }

    /// Turned and moved (m/s).
    template <int dim>
    Tensor<1, dim>
    rigid(const Point<dim> &x)
    {
      Tensor<1, dim> v;
      v[0] = 0.3 - (x[1] - 0.5);
      v[1] = x[0] - 0.4;
      return v;
    }

    /// Through the surface outside solids (m^dim/s).
    template <int dim>
    double
    flux(const Body<dim> &body, const NodeVector<dim> &v)
    {
      const Mesh<dim> &mesh   = *body.state.mesh;
      double           result = 0;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        for_each_facet(mesh,
                       body.state.phi,
                       c,
                       [&](const std::array<Point<dim>, dim> &x) {
                         Point<dim> middle;
                         for (const Point<dim> &p : x)
                           middle += p / dim;
                         if (body.scene.solid_distance(middle, 0) < 0)
                           return;
                         const LocalIndex     first = mesh.cell_nodes[c][0];
                         const Tensor<1, dim> there =
                           v.value(first) + velocity_gradient(mesh, c, v) *
                                              (middle - mesh.node_position[first]);
                         result += area_vector<dim>(x) * there;
                       });
      return Utilities::MPI::sum(result, mesh.communicator());
    }

    template <int dim>
    double
    largest_change(const NodeVector<dim> &a,
                   const NodeVector<dim> &b,
                   const Mesh<dim>       &mesh)
    {
      double change = 0;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        change = std::max(change, (a.value(node) - b.value(node)).norm());
      return Utilities::MPI::max(change, mesh.communicator());
    }

    std::string
    bounded(const double value, const double bound)
    {
      return std::abs(value) < bound ? "below " + digits(bound) :
                                       "TOO MUCH, " + digits(value);
    }

    template <int dim>
    void
    check(const MPI_Comm &comm, const unsigned int level)
    {
      const Body<dim>  body(comm,
                           graded_mesh(level) +
                             "subsection Liquid 1\nset Radius = 0.3\nset Centre = " +
                             (dim == 2 ? "0.5, 0.5" : "0.5, 0.5, 0.5") + "\nend\n");
      const Mesh<dim> &mesh     = *body.state.mesh;
      const auto       swelling = at_nodes<dim>(mesh, [&](const LocalIndex node) {
        const Tensor<1, dim> r = mesh.node_position[node] - diagonal_point<dim>(0.5);
        const double         length = std::max(r.norm(), 1e-3);
        const double         beside =
          std::clamp(1 + body.state.phi.local_element(node) / (1.5 * mesh.finest_size()),
                     0.,
                     1.);
        return rigid(mesh.node_position[node]) +
               0.3 * beside * (1 + r[0] / length) * r / length;
      });
      NodeVector<dim>  v        = combined(1, swelling, 0, swelling);
      remove_divergence(body.state, body.domain, v);
      out() << dim << "D, swelling: flux " << digits(flux(body, swelling)) << ", then "
            << bounded(flux(body, v) / flux(body, swelling), 1e-2) << " of it";

      const auto turning = at_nodes<dim>(mesh, [&](const LocalIndex node) {
        return rigid(mesh.node_position[node]);
      });
      v                  = combined(1, turning, 0, turning);
      remove_divergence(body.state, body.domain, v);
      out() << "; a rigid motion changes by "
            << bounded(largest_change(v, turning, mesh), 1e-12) << std::endl;
    }

    /// Half spaces above and below a gap, a third of a leaf wide, that close it.
    template <int dim>
    void
    check_gap(const MPI_Comm &comm, const unsigned int level)
    {
      Body<dim>        body(comm,
                     uniform_mesh(level) + "subsection Liquid 1\nset Shape = half space\nend\n");
      const Mesh<dim> &mesh = *body.state.mesh;
      body.state.phi.zero_out_ghost_values();
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        body.state.phi.local_element(node) =
          mesh.finest_size() / 6 - std::abs(mesh.node_position[node][1] - 0.5);
      body.state.phi.update_ghost_values();
      const LiquidDomain<dim> domain(body.prm.liquid_domain, body.state, body.data);
      const auto              closing = at_nodes<dim>(mesh, [&](const LocalIndex node) {
        Tensor<1, dim> v;
        v[1] = mesh.node_position[node][1] > 0.5 ? -1 : 1;
        return v;
      });
      NodeVector<dim>         v       = combined(1, closing, 0, closing);
      remove_divergence(body.state, domain, v);
      double towards = 1;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (std::abs(mesh.node_position[node][1] - 0.5) < 1.1 * mesh.finest_size() &&
            mesh.node_sides[node] == 0)
          towards = std::min(towards, std::abs(v.value(node)[1]));
      out() << dim << "D, a gap: " << bounded(1 - Utilities::MPI::min(towards, comm), 0.1)
            << " slower" << std::endl;
    }

    /// Half a leaf thick, along y, stretched with a velocity that is continued from it.
    template <int dim>
    void
    check_thread(const MPI_Comm &comm, const unsigned int level)
    {
      const Body<dim> body(comm,
                           uniform_mesh(level) + "subsection Liquid 1\nset Shape = expression\nset Expression = max(" +
                             (dim == 2 ? "abs(x - 0.5)" : "sqrt((x - 0.5)^2 + (z - 0.5)^2)") + " - 0.25 / 2^" +
                             std::to_string(level) + ", abs(y - 0.5) - 0.3)\nend\n");
      const auto      stretched = at_nodes<dim>(*body.state.mesh, [&](const LocalIndex node) {
        Tensor<1, dim> v;
        v[1] = body.state.mesh->node_position[node][1];
        return v;
      });
      NodeVector<dim> v         = combined(1, stretched, 0, stretched);
      remove_divergence(body.state, body.domain, v);
      out() << dim << "D, a thread: flux " << digits(flux(body, stretched)) << ", then "
            << bounded(flux(body, v) / flux(body, stretched), 0.1) << " of it" << std::endl;
    }

    /// On a wall that holds the liquid.
    template <int dim>
    void
    check_wall(const MPI_Comm &comm, const unsigned int level)
    {
      const Body<dim> body(
        comm,
        graded_mesh(level) +
          "subsection Liquid 1\nset Shape = half space\nset Centre = " +
          (dim == 2 ? "0, 0.05\nset Normal = 0, 1" : "0, 0.05, 0\nset Normal = 0, 1, 0") +
          "\nend\n");
      const Mesh<dim> &mesh   = *body.state.mesh;
      const auto       rising = at_nodes<dim>(mesh, [&](const LocalIndex node) {
        Tensor<1, dim> v;
        if (body.domain.constrained[node] == 0)
          v[1] = 1 + mesh.node_position[node][0];
        return v;
      });
      NodeVector<dim>  v      = combined(1, rising, 0, rising);
      remove_divergence(body.state, body.domain, v);
      double moved = 0;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (body.domain.constrained[node] != 0)
          moved = std::max(moved, v.value(node).norm());
      out() << dim << "D, a layer that rises from a wall: flux "
            << digits(flux(body, rising)) << ", then "
            << bounded(flux(body, v) / flux(body, rising), 1e-2)
            << " of it; the wall moves by "
            << bounded(Utilities::MPI::max(moved, comm), 1e-15) << std::endl;
    }

    /// One about a solid, which moves as that does.
    template <int dim>
    void
    check_moving_solid(const MPI_Comm &comm, const unsigned int level)
    {
      const Body<dim>   body(comm,
                           graded_mesh(level) + "subsection Liquid 1\nset Radius = 0.3\nset Centre = 0.5, 0.5" +
                             (dim == 2 ? "" : ", 0.5") + "\nend\nsubsection Solid 1\nset Shape = sphere\nset Radius = 0.21\nset Centre = 0.4, 0.5" +
                             (dim == 2 ? "" : ", 0.5") + "\nset Centre of rotation = 0.4, 0.2" + (dim == 2 ? "" : ", 0.5") +
                             "\nset Angular velocity = " + (dim == 2 ? "1" : "0; 0; 1") + "\nset Velocity = " +
                             (dim == 2 ? "0.6; 0" : "0.6; 0; 0") + "\nend\n",
                           1);
      const auto      moving = at_nodes<dim>(*body.state.mesh, [&](const LocalIndex node) {
        return body.scene.solid_velocity(body.state.mesh->node_position[node], 0);
      });
      NodeVector<dim> v      = combined(1, moving, 0, moving);
      remove_divergence(body.state, body.domain, v);
      out() << dim << "D, with a solid: a rigid motion changes by " << bounded(largest_change(v, moving, *body.state.mesh), 1e-12)
            << std::endl;
    }

    /// Half of one, on a solid that cuts cells: beside its surface it moves into that.
    template <int dim>
    void
    check_solid(const MPI_Comm &comm, const unsigned int level)
    {
      const std::string middle = dim == 2 ? "0.5, 0.51" : "0.5, 0.51, 0.5";
      const Body<dim>   body(comm,
                           graded_mesh(level) + "subsection Liquid 1\nset Radius = 0.3\nset Centre = " + middle +
                             "\nend\nsubsection Solid 1\nset Shape = half space\nset Centre = " + middle +
                             "\nset Normal = " + (dim == 2 ? "0, 1" : "0, 1, 0") + "\nend\n",
                           1);
      const Mesh<dim>  &mesh = *body.state.mesh;
      const auto        down = at_nodes<dim>(mesh, [&](const LocalIndex node) {
        Tensor<1, dim> v;
        v[1] = -std::clamp(1 + body.state.phi.local_element(node) / (1.5 * mesh.finest_size()), 0., 1.);
        return v;
      });
      double area = 0, through = 0;
      for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
        for (const WettedWall<dim> &wall : wetted_walls(body.domain, body.state, c))
          {
            area -= wall.area[1];
            through += wall.mean([&](const unsigned int i) { return down.value(mesh.cell_nodes[c][i]); }) * wall.area;
          }
      area            = Utilities::MPI::sum(area, comm) / (dim == 2 ? 0.6 : 0.09 * numbers::PI);
      through         = Utilities::MPI::sum(through, comm);
      NodeVector<dim> v = combined(1, down, 0, down);
      remove_divergence(body.state, body.domain, v);
      out() << dim << "D, on a solid: its wall is wet by " << bounded(area - 1, 0.01) << " more than it is; through the wall "
            << digits(through) << ", then through the surface " << bounded(flux(body, v) / through, 0.1) << " of it" << std::endl;
    }

    void
    test(const int, char **)
    {
      on_1_2_3_ranks([](const MPI_Comm &comm) {
        check<2>(comm, 5);
        check<3>(comm, 4);
        check_gap<2>(comm, 4);
        check_gap<3>(comm, 4);
        check_thread<2>(comm, 4);
        check_thread<3>(comm, 4);
        check_wall<2>(comm, 5);
        check_wall<3>(comm, 4);
        check_moving_solid<2>(comm, 5);
        check_moving_solid<3>(comm, 4);
        check_solid<2>(comm, 5);
        check_solid<3>(comm, 4);
      });
    }
  } // namespace

  const Test registered("transport/surface_divergence", test);
} // namespace tests::transport_surface_divergence
