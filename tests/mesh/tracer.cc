// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Location, evaluation and tracing anywhere in the box on 1, 2 and 3 ranks: linear
// fields are exact, distances with gradients all but that, what has no change across its gradient
// is as without, and a rotation is followed to third order in dt (the error of a path falls 16 times
// when dt is halved).

#include <treacle/mesh/tracer.h>

#include "../tests.h"

#include <random>

namespace tests::mesh_tracer
{
using namespace treacle;

template <int dim>
void
check(const MPI_Comm &comm)
{
  typename Octree<dim>::Parameters prm;
  for (unsigned int d = 0; d < dim; ++d)
    prm.upper_corner[d] = d == 0 ? 2 : 1;
  prm.surface_level = dim == 2 ? 5 : 4;
  const auto octree = std::make_shared<const Octree<dim>>(
    comm,
    prm,
    [](const std::vector<Leaf<dim>> &leaves) {
      std::vector<bool> refine;
      for (const Leaf<dim> &leaf : leaves)
        refine.push_back(leaf.level < 2 || leaf.origin[0] <= 20);
      return refine;
    });
  const Mesh<dim> mesh(octree);

  // from a ball, and what goes as it likes along its gradient, which is linear between nodes
  Point<dim> far;
  far[0]               = -7;
  const auto distance  = [&far](const Point<dim> &x) { return x.distance(far) - 8; };
  const auto along     = [](const Point<dim> &x) { return x[0] + 2 * x[dim - 1]; };
  const auto linear    = [](const Point<dim> &x) { return 2 * x[0] - 3 * x[dim - 1] + 0.5; };
  treacle::Vector r = mesh.zeros(mesh.nodes), s = r, l = r, smooth = r;
  NodeVector<dim> gradient_of_r(mesh.nodes), gradient_of_s(mesh.nodes), rotation(mesh.nodes);
  for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
    {
      const Point<dim> &x   = mesh.node_position[node];
      r.local_element(node) = distance(x);
      s.local_element(node) = along(x) * along(x) * along(x);
      l.local_element(node) = linear(x);
      smooth.local_element(node) = 1;
      Tensor<1, dim> g, v;
      g[0]       = 3 * along(x) * along(x);
      g[dim - 1] = 2 * g[0];
      gradient_of_r.set(node, (x - far) / x.distance(far));
      gradient_of_s.set(node, g);
      v[0] = -(x[1] - 0.5);
      v[1] = x[0] - 1;
      rotation.set(node, v);
    }
  r.update_ghost_values();
  s.update_ghost_values();
  l.update_ghost_values();
  smooth.update_ghost_values();
  gradient_of_r.update_ghost_values();
  gradient_of_s.update_ghost_values();
  rotation.update_ghost_values();

  // each rank asks for points all over the box, corners and walls among them
  std::mt19937                           generator(17);
  std::uniform_real_distribution<double> random(0, 1);
  std::vector<Point<dim>>                x;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = prm.upper_corner[d] * (i < 100 ? std::round(random(generator)) :
                                      i < 200 ? std::round(32 * random(generator)) / 32 :
                                                random(generator));
      x.push_back(p);
    }
  const Tracer<dim>         tracer(mesh);
  const std::vector<double> values = tracer.evaluate(x, {{&l}, {&s, &gradient_of_s, &smooth}, {&s}, {&r, &gradient_of_r, &smooth}, {&r}});
  double                    error = 0, of_distance = 0, of_chords = 0;
  for (unsigned int i = 0; i < x.size(); ++i)
    {
      const double *at = &values[5 * i];
      error            = std::max({error, std::abs(at[0] - linear(x[i])), std::abs(at[1] - at[2])});
      of_distance      = std::max(of_distance, std::abs(at[3] - distance(x[i])));
      of_chords        = std::max(of_chords, std::abs(at[4] - distance(x[i])));
    }

  std::vector<Point<dim>> start;
  for (const Point<dim> &p : x)
    if (std::hypot(p[0] - 1, p[1] - 0.5) < 0.45)
      start.push_back(p);
  std::array<double, 2> path_error{};
  for (const unsigned int n : {1, 2})
    {
      const double dt  = 0.4 / n;
      const auto   end = tracer.trace(start, rotation, dt);
      for (unsigned int i = 0; i < start.size(); ++i)
        {
          const double a = start[i][0] - 1, b = start[i][1] - 0.5;
          Point<dim>   exact = start[i];
          exact[0]           = 1 + a * std::cos(dt) - b * std::sin(dt);
          exact[1]           = 0.5 + a * std::sin(dt) + b * std::cos(dt);
          path_error[n - 1]  = std::max(path_error[n - 1], end[i].distance(exact));
        }
    }
  tests::out() << dim << "D: cells " << mesh.cells->size() << ", fields "
               << (Utilities::MPI::max(error, comm) < 1e-12 ? "exact" : "WRONG") << ", distance off by "
               << Utilities::MPI::max(of_distance, comm) << ", chords " << Utilities::MPI::max(of_chords, comm)
               << ", path error " << Utilities::MPI::max(path_error[0], comm)
               << ", halved dt: smaller by "
               << std::round(Utilities::MPI::max(path_error[0], comm) /
                             Utilities::MPI::max(path_error[1], comm))
               << std::endl;
}

/// What is not finite lies in no cell.
void
check_lost_point()
{
  Octree<2>::Parameters prm;
  prm.upper_corner = Point<2>(1, 1);
  const Mesh<2> mesh(std::make_shared<const Octree<2>>(
    MPI_COMM_SELF,
    prm,
    [](const std::vector<Leaf<2>> &leaves) { return std::vector<bool>(leaves.size(), false); }));
  const treacle::Vector zero  = mesh.zeros(mesh.nodes);
  std::string           found = "no error";
  try
    {
      Tracer<2>(mesh).evaluate({Point<2>(std::nan(""), 0.5)}, {{&zero}});
    }
  catch (const ExceptionBase &error)
    {
      found = std::string(error.what()).find("not finite") == std::string::npos ? "another error" : "refused";
    }
  tests::out() << "a point that is not finite: " << found << std::endl;
}

void
start(const int, char **)
{
  tests::on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
  });
  check_lost_point();
}

const Test test("mesh/tracer", start);
} // namespace tests::mesh_tracer
