// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// A smooth vector field that a prescribed rotation carries once round, on meshes of
// twice the cells in each direction and twice the steps: the mean error falls to a half
// with semi-Lagrangian advection, to a quarter with MacCormack's correction, and no value
// grows. Then a sphere that rotates freely, by the whole program, with either scheme:
// the same on 1, 2 and 3 ranks. Argument: levels to add. Last the size of a step by gravity,
// and what is not finite.

#include <treacle/mesh/tracer.h>
#include <treacle/transport/back_and_forth.h>

#include "../body.h"
#include "../tests.h"

#include <numeric>

namespace tests::transport_advection
{
template <int dim>
std::shared_ptr<const Mesh<dim>>
uniform_mesh(const MPI_Comm &comm, const unsigned int level)
{
  typename Octree<dim>::Parameters prm;
  prm.upper_corner  = diagonal_point<dim>(1);
  prm.surface_level = level;
  return std::make_shared<const Mesh<dim>>(std::make_shared<const Octree<dim>>(
    comm,
    prm,
    [&](const std::vector<Leaf<dim>> &leaves) {
      std::vector<bool> refine;
      for (const Leaf<dim> &leaf : leaves)
        refine.push_back(leaf.level < level);
      return refine;
    }));
}

template <int dim>
double
error_of_revolution(const MPI_Comm &comm, const unsigned int level, const bool is_corrected)
{
  const auto       mesh_pointer = uniform_mesh<dim>(comm, level);
  const Mesh<dim> &mesh         = *mesh_pointer;
  Point<dim>       c            = diagonal_point<dim>(0.5);
  c[0] += 0.15;
  NodeVector<dim> rotation(mesh.nodes), field(mesh.nodes), start(mesh.nodes);
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    {
      const Point<dim> &x = mesh.node_position[node];
      Tensor<1, dim>    v, f;
      v[0] = -2 * numbers::PI * (x[1] - 0.5);
      v[1] = 2 * numbers::PI * (x[0] - 0.5);
      f[0] = std::exp(-(x - c).norm_square() / 0.02);
      f[1] = (x[0] - c[0]) * f[0];
      rotation.set(node, v);
      field.set(node, f);
      start.set(node, f);
    }
  rotation.update_ghost_values();
  field.update_ghost_values();

  std::vector<LocalIndex> nodes(mesh.n_owned_nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  const std::vector<Point<dim>> x(mesh.node_position.begin(),
                                  mesh.node_position.begin() + nodes.size());
  std::vector<const treacle::Vector *> components;
  for (const auto &component : field.component)
    components.push_back(&component);

  const unsigned int n_steps = 1u << (level - 1);
  const double       dt      = 1. / n_steps;
  const Tracer<dim>  tracer(mesh);
  const auto         origins = tracer.trace(x, rotation, -dt);
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      std::vector<treacle::Vector> correction;
      if (is_corrected)
        correction = back_and_forth_error<dim>(mesh, components, rotation, dt, nodes, nodes);
      std::vector<NodeField<dim>> fields;
      for (unsigned int d = 0; d < dim; ++d)
        fields.push_back(
          {components[d], nullptr, nullptr, is_corrected ? &correction[d] : nullptr});
      const std::vector<double> values = tracer.evaluate(origins, fields);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          field.component[d].local_element(i) = values[i * dim + d];
      field.update_ghost_values();
    }

  double error = 0, size = 0, largest = 0;
  for (const LocalIndex node : nodes)
    {
      error += (field.value(node) - start.value(node)).norm();
      size += start.value(node).norm();
      largest = std::max(largest, field.value(node)[0]);
    }
  AssertThrow(Utilities::MPI::max(largest, comm) < 1 + 1e-12, ExcInternalError());
  return Utilities::MPI::sum(error, comm) / Utilities::MPI::sum(size, comm);
}

template <int dim>
void
check_errors(const MPI_Comm &comm, const unsigned int first, const unsigned int last)
{
  for (const bool is_corrected : {false, true})
    {
      out() << dim << "D, " << (is_corrected ? "MacCormack" : "semi-Lagrangian") << ": error";
      for (unsigned int level = first; level <= last; ++level)
        out() << ' ' << error_of_revolution<dim>(comm, level, is_corrected);
      out() << std::endl;
    }
}

template <int dim>
void
check_scene(const MPI_Comm &comm, const std::string &scheme)
{
  const std::string rest = dim == 2 ? "" : "; 0";
  const auto        rows = run_scene<dim>(
    comm,
    "set End time = 0.06\nset Frame interval = 0.06\nset Maximum time step = 0.02\n"
    "subsection Mesh\nset Surface level = 4\nset Interior level = 3\nset Air level = 2\nend\n"
    "subsection Gravity\nset Acceleration = 0; 0" +
      rest +
      "\nend\nsubsection Material\nset Density = 1\nset Viscosity = 0.001\nend\n"
      "subsection Liquid 1\nset Radius = 0.25\nset Velocity = 0.1 - 2*pi*(y-0.5)*(1+2*x); "
      "2*pi*(x-0.5)" +
      rest + "\nend\nsubsection Advection\nset Scheme = " + scheme + "\nend\n" +
      tolerance("1e-10"));
  out() << dim << "D, " << scheme << ": kinetic energy / first "
        << rows.back().at("Kinetic energy (J)") / rows[1].at("Kinetic energy (J)")
        << ", angular momentum / first "
        << rows.back().at(dim == 2 ? "Angular momentum (kg m^2/s)" : "Angular momentum z (kg m^2/s)") /
             rows[1].at(dim == 2 ? "Angular momentum (kg m^2/s)" : "Angular momentum z (kg m^2/s)")
        << std::endl;
}

/// The size of a step in still liquid, by gravity where it is, not in the box's middle; and
/// what is not finite ends all ranks alike.
void
check_steps(const MPI_Comm &comm)
{
  TimeStep<2>::Parameters prm;
  prm.frame_interval = prm.maximum = 1;
  const auto show = [&](const std::string &what, const auto &action) {
    out() << what << ": ";
    try
      {
        action();
      }
    catch (const UserError &error)
      {
        out() << error.what();
      }
    out() << std::endl;
  };
  const std::string r = "sqrt((x-0.5)^2+(y-0.5)^2)";
  for (const std::string &gravity : {std::string("0; -9.81"),
                                    "-9.81*(x-0.5)/" + r + "; -9.81*(y-0.5)/" + r,
                                    std::string("-40*(x-0.5); -40*(y-0.5)"),
                                    std::string("if(x > 0.6, 1/0, 0); 0")})
    show("gravity " + gravity, [&] {
      const Body<2> body(comm, "subsection Gravity\nset Acceleration = " + gravity + "\nend\n");
      out() << TimeStep<2>(prm).next(body.state, body.domain, 1, {true, false}).dt;
    });

  Body<2>      body(comm, "subsection Liquid 1\nset Centre = 0.5, 0.4\nend\n");
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (Utilities::MPI::this_mpi_process(comm) + 1 == Utilities::MPI::n_mpi_processes(comm))
    for (LocalIndex node = 0; node < body.state.v.component[0].locally_owned_size(); ++node)
      if (body.domain.is_active_node[node])
        body.state.v.component[0].local_element(node) = nothing;
  body.state.v.update_ghost_values();
  body.state.u = nothing;
  body.state.u.update_ghost_values();
  body.state.time = 0.3;
  show("a velocity that is none", [&] { maximum_speed(body.state, body.domain); });
  out() << "speed " << measure(body.state, body.domain).maximum_speed << ", divergence "
        << PressureSystem<2>::maximum_divergence(body.state, body.domain) << std::endl;
  body.state.material.emplace(body.state.mesh->nodes);
  body.state.material->update_ghost_values();
  show("no density", [&] { LiquidDomain<2>(body.prm.liquid_domain, body.state, body.data); });
}

void
start(const int argc, char **argv)
{
  const unsigned int               more = argc > 1 ? std::stoi(argv[1]) : 0;
  out().precision(5);
  on_1_2_3_ranks([&](const MPI_Comm &comm) {
    check_steps(comm);
    check_errors<2>(comm, 5, 6 + more);
    check_errors<3>(comm, 4, 4 + more);
    for (const char *scheme : {"semi-Lagrangian", "MacCormack"})
      {
        check_scene<2>(comm, scheme);
        check_scene<3>(comm, scheme);
      }
  });
}

const Test test("transport/advection", start);
} // namespace tests::transport_advection
