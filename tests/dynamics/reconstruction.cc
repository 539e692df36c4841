// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Node velocity from exact face velocity on a free disc and sphere, graded from the surface:
// the error of each reconstruction, in the norm of the node mass relative to the field, and
// at the worst active node. Arguments: dimension, levels.

#include "../tests.h"
#include "../body.h"

#include <iomanip>

namespace tests::dynamics_reconstruction
{
namespace
{
  template <int dim>
  Tensor<1, dim>
  rigid(const Point<dim> &x)
  {
    Tensor<1, dim> u;
    u[0] = 0.5 - x[1];
    u[1] = x[0] - 0.5;
    return u;
  }

  template <int dim>
  Tensor<1, dim>
  smooth(const Point<dim> &x)
  {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = std::sin(5 * x[(d + 1) % dim] + d) + std::cos(4 * x[d]);
    return u;
  }

  template <int dim>
  void
  check(Body<dim> &body, const typename Reconstruction<dim>::Method method)
  {
    const Mesh<dim> &mesh = *body.state.mesh;
    const MPI_Comm  &comm = mesh.communicator();
    for (const auto &field : {&rigid<dim>, &smooth<dim>})
      {
        body.set_velocity(field);
        body.state.v = NodeVector<dim>(mesh.nodes);
        Reconstruction<dim>({method}).advance(body.state, body.fit, 1);
        double error = 0, size = 0, worst = 0;
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          if (body.domain.is_active_node[node])
            {
              const Tensor<1, dim> u = field(mesh.node_position[node]);
              const Tensor<1, dim> e = body.state.v.value(node) - u;
              error += body.domain.node_mass[node] * e.norm_square();
              size += body.domain.node_mass[node] * u.norm_square();
              worst = std::max(worst, e.norm());
            }
        error = std::sqrt(Utilities::MPI::sum(error, comm) / Utilities::MPI::sum(size, comm));
        worst = Utilities::MPI::max(worst, comm);
        out() << (field == &rigid<dim> ? " rigid " : ", smooth ");
        if (worst < 1e-9)
          out() << "below 1e-9";
        else
          out() << error << " and " << worst;
      }
    out() << std::endl;
  }

  template <int dim>
  void
  check_all(const MPI_Comm &comm, const std::vector<unsigned int> &levels)
  {
    using Method = typename Reconstruction<dim>::Method;
    for (const unsigned int level : levels)
      {
        Body<dim> body(comm,
                       graded_mesh(level) + "subsection Liquid 1\nset Radius = 0.3\nset Centre = " +
                         (dim == 2 ? "0.503, 0.491" : "0.503, 0.491, 0.512") + "\nend\n" +
                         tolerance("1e-12"));
        for (const auto &[name, method] : {std::make_pair("face fitted", Method::face_fitted),
                                           std::make_pair("least squares", Method::least_squares),
                                           std::make_pair("two step", Method::two_step)})
          {
            out() << dim << "D, level " << level << ", " << name << ":" << std::setprecision(3);
            check(body, method);
          }
      }
  }
} // namespace

void
start(const int argc, char **argv)
{
  std::vector<unsigned int>        levels;
  for (int i = 2; i < argc; ++i)
    levels.push_back(std::stoi(argv[i]));
  if (argc > 2 && argv[1][0] == '2')
    check_all<2>(MPI_COMM_WORLD, levels);
  else if (argc > 2)
    check_all<3>(MPI_COMM_WORLD, levels);
  else
    on_1_2_3_ranks([](const MPI_Comm &comm) {
      check_all<2>(comm, {4, 5});
      check_all<3>(comm, {3, 4});
    });
}

const Test test("dynamics/reconstruction", start);
} // namespace tests::dynamics_reconstruction
