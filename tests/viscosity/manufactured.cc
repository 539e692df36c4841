// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// One viscous step in a box without slip, full of liquid, on a graded mesh, viscosity
// exp(1 + x) cos(y) (case A7), from the velocity that has the exact solution after it: the
// solve at the nodes alone, and with each mapping. Error at the nodes, and at the faces,
// relative to the solution, in the norm of the masses and at the worst one. Arguments:
// dimension, levels, settings.

#include "../tests.h"
#include "../body.h"

#include <iomanip>

namespace tests::viscosity_manufactured
{
namespace
{
  template <int dim>
  Tensor<1, dim>
  velocity(const Point<dim> &x)
  {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      {
        u[d] = 1;
        for (unsigned int e = 0; e < dim; ++e)
          u[d] *= std::sin((e == d ? 2 : 1) * numbers::PI * x[e]);
      }
    u[0] *= -2;
    return u;
  }

  template <int dim>
  double
  viscosity(const Point<dim> &x)
  {
    return std::exp(1 + x[0]) * std::cos(x[1]);
  }

  /// Derivative along an axis, of fourth order.
  template <int dim, typename Function>
  auto
  derivative(const Function &f, const Point<dim> &x, const unsigned int axis)
  {
    constexpr double h    = 1e-3;
    Tensor<1, dim>   step;
    step[axis] = 1;
    return (8 * (f(x + h * step) - f(x - h * step)) - (f(x + 2 * h * step) - f(x - 2 * h * step))) /
           (12 * h);
  }

  /// div(mu (grad u + grad u^T))
  template <int dim>
  Tensor<1, dim>
  force(const Point<dim> &x)
  {
    const auto stress = [](const Point<dim> &y) {
      Tensor<2, dim> gradient;
      for (unsigned int e = 0; e < dim; ++e)
        {
          const Tensor<1, dim> column = derivative<dim>(velocity<dim>, y, e);
          for (unsigned int d = 0; d < dim; ++d)
            gradient[d][e] = column[d];
        }
      return viscosity(y) * (gradient + transpose(gradient));
    };
    Tensor<1, dim> result;
    for (unsigned int e = 0; e < dim; ++e)
      {
        const Tensor<2, dim> along = derivative<dim>(stress, x, e);
        for (unsigned int d = 0; d < dim; ++d)
          result[d] += along[d][e];
      }
    return result;
  }

  /// The smallest leaves around a sphere, one and two levels coarser ones beyond.
  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  graded(const MPI_Comm &comm, const unsigned int level)
  {
    typename Octree<dim>::Parameters prm;
    for (unsigned int d = 0; d < dim; ++d)
      prm.upper_corner[d] = 1;
    prm.surface_level = level;
    prm.interior_level = prm.air_level = 0;
    const auto refine = [&](const std::vector<Leaf<dim>> &leaves) {
      std::vector<bool> result;
      for (const Leaf<dim> &leaf : leaves)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = leaf.centre()[d] / static_cast<double>(2 << level);
          const double distance = x.distance(diagonal_point<dim>(0.35));
          result.push_back(leaf.level + 2 < level || (leaf.level + 1 < level && distance < 0.5) ||
                           distance < 0.25);
        }
      return result;
    };
    return std::make_shared<const Mesh<dim>>(
      std::make_shared<const Octree<dim>>(comm, prm, refine));
  }

  struct Error
  {
    double sum = 0, size = 0, worst = 0, largest = 0;

    template <typename Value>
    void
    add(const double mass, const Value &value, const Value &exact)
    {
      const double e = norm(value - exact), u = norm(exact);
      sum += mass * e * e;
      size += mass * u * u;
      worst   = std::max(worst, e);
      largest = std::max(largest, u);
    }

    static double
    norm(const double x)
    {
      return std::abs(x);
    }

    template <int dim>
    static double
    norm(const Tensor<1, dim> &x)
    {
      return x.norm();
    }

    /// Collective.
    std::string
    text(const MPI_Comm &comm) const
    {
      std::ostringstream text;
      text << std::setprecision(3)
           << std::sqrt(Utilities::MPI::sum(sum, comm) / Utilities::MPI::sum(size, comm)) << ", "
           << Utilities::MPI::max(worst, comm) / Utilities::MPI::max(largest, comm);
      return text.str();
    }
  };

  constexpr double dt = 0.1;

  template <int dim>
  std::string
  parameters(const std::string &mapping)
  {
    return std::string("subsection Material\nset Density = 1\n") +
           "set Viscosity = exp(1 + x) * cos(y)\nend\nsubsection Liquid 1\n" +
           "set Shape = half space\nset Centre = " + (dim == 2 ? "0, 10" : "0, 0, 10") +
           "\nset Normal = " + (dim == 2 ? "0, 1" : "0, 0, 1") +
           "\nend\n" + with_mapping(mapping) + tolerance("1e-11") +
           "subsection Linear solvers\nsubsection Viscosity\nset Maximum iterations = 100000\nend\nend\n";
  }

  template <int dim>
  Error
  error_at_nodes(const Body<dim> &body)
  {
    const Mesh<dim> &mesh = *body.state.mesh;
    Error            error;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      error.add(body.domain.node_mass[node],
                body.state.v.value(node),
                velocity(mesh.node_position[node]));
    return error;
  }

  /// A step of the nodes alone.
  template <int dim>
  void
  solve_at_nodes(Body<dim> &body)
  {
    const LiquidDomain<dim>    &domain = body.domain;
    const Mesh<dim>            &mesh   = domain.mesh;
    const NodeSystem<dim>      &system = body.fit.system;
    typename NodeSystem<dim>::Stiffness stiffness;
    for (LocalIndex c = 0; c < domain.viscosity.size(); ++c)
      stiffness.strain.push_back(dt * domain.viscosity[c] * domain.liquid_volume[c]);
    std::vector<Tensor<1, dim>> momentum(mesh.node_position.size());
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      momentum[node] = domain.node_mass[node] * (velocity(mesh.node_position[node]) -
                                                 dt * force(mesh.node_position[node]));
    const auto         assembled = system.assemble(NodeSystem<dim>::Mass::nodes, stiffness);
    const LinearSolver solver(body.prm.dynamics.viscosity.solver,
                              "Viscosity",
                              *assembled.matrix,
                              [&] { return system.stress_free_motions(stiffness); });
    treacle::Vector    x = system.unknowns(body.state.v);
    solver.solve(x, system.right_hand_side(momentum, assembled));
    system.to_nodes(x, body.state.v);
  }

  /// Of faces, and of the node velocity that the step leaves.
  template <int dim>
  std::pair<Error, Error>
  errors_of_step(Body<dim> &body)
  {
    const LiquidDomain<dim> &domain = body.domain;
    const Mesh<dim>         &mesh   = domain.mesh;
    body.set_velocity([](const Point<dim> &x) { return velocity(x) - dt * force(x); });
    Viscosity<dim>(body.prm.dynamics.viscosity).advance(body.state, body.fit, dt);
    Error of_faces;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        of_faces.add(domain.face_mass[f],
                     body.state.u.local_element(f),
                     velocity(mesh.face_centre(f)) * mesh.face_normal[f]);
    return {of_faces, error_at_nodes(body)};
  }

  template <int dim>
  void
  check(const MPI_Comm &comm, const std::vector<unsigned int> &levels)
  {
    for (const std::string mapping : {"nodes alone", "hybrid", "face fitted FLIP",
                                      "face fitted PIC", "face coupled", "node FLIP", "node PIC"})
      for (const unsigned int level : levels)
        {
          const bool nodes = mapping == "nodes alone";
          Body<dim>  body(graded<dim>(comm, level),
                         parameters<dim>(nodes ? "face fitted FLIP" : mapping));
          out() << dim << "D, level " << level << ", " << mapping << std::setprecision(3) << ": ";
          if (nodes)
            {
              solve_at_nodes(body);
              out() << error_at_nodes(body).text(comm) << std::endl;
              continue;
            }
          const auto [of_faces, of_nodes] = errors_of_step(body);
          out() << of_nodes.text(comm) << ", " << of_faces.text(comm) << std::endl;
        }
  }
} // namespace

void
start(const int argc, char **argv)
{
  run(argc, argv, check<2>, check<3>, [](const MPI_Comm &comm) {
    check<2>(comm, {4, 5});
    check<3>(comm, {3});
  });
}

const Test test("viscosity/manufactured", start);
} // namespace tests::viscosity_manufactured
