// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Signed distances of every shape as the parameter file describes them:
// values, unit gradients that lead to the surface, and messages.

#include <treacle/base/exceptions.h>
#include <treacle/geometry/shapes.h>
#include <treacle/geometry/triangle_surface.h>

#include <random>

#include "../tests.h"

namespace tests::geometry_shapes
{
using namespace treacle;

template <int dim>
Shape<dim>
make(const std::string &text)
{
  ParameterHandler                prm;
  typename Shape<dim>::Parameters parameters;
  prm.enter_subsection("Liquid 1");
  parameters.add_parameters(prm);
  prm.leave_subsection();
  prm.parse_input_from_string("subsection Liquid 1\n" + text + "\nend\n");
  return Shape<dim>(parameters, "Liquid 1", 1e-12);
}

template <int dim>
Point<dim>
random_point()
{
  static std::mt19937                    generator(3);
  std::uniform_real_distribution<double> random(-0.5, 1.5);
  Point<dim>                             p;
  for (unsigned int d = 0; d < dim; ++d)
    p[d] = random(generator);
  return p;
}

/// How often x - d grad d is off the surface. Near the few points of the
/// medial axis the difference quotient fails, so a handful may.
template <int dim>
unsigned int
n_not_distances(const Shape<dim> &shape)
{
  unsigned int n = 0;
  for (unsigned int sample = 0; sample < 1000; ++sample)
    {
      const Point<dim> x = random_point<dim>();
      Tensor<1, dim>   gradient;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Tensor<1, dim> step = 1e-6 * Point<dim>::unit_vector(d);
          gradient[d] =
            (shape.signed_distance(x + step) - shape.signed_distance(x - step)) / 2e-6;
        }
      const Point<dim> foot = x - shape.signed_distance(x) * gradient;
      n += std::abs(gradient.norm() - 1) > 1e-5 ||
           std::abs(shape.signed_distance(foot)) > 1e-5;
    }
  return n;
}

template <int dim>
void
show(const std::string &text, const std::vector<Point<dim>> &points)
{
  const Shape<dim> shape = make<dim>(text);
  tests::out() << text.substr(0, text.find('\n')) << ":";
  for (const Point<dim> &p : points)
    tests::out() << ' ' << shape.signed_distance(p);
  const unsigned int n = n_not_distances<dim>(shape);
  tests::out() << ", distance " << (n < 5 ? "yes" : "no") << std::endl;
}

template <int dim>
void
show_error(const std::string &text)
{
  try
    {
      make<dim>(text);
      tests::out() << "no error: " << text << std::endl;
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

void
write(const std::string &name, const std::string &text)
{
  std::ofstream(name) << text;
}

const std::string cube_corners =
  "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
const std::string cube_sides = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n";

void
check_triangle_mesh()
{
  write("cube.off", "OFF\n8 6 0\n" + cube_corners + cube_sides + "4 3 0 4 7\n");
  write("open.off", "OFF\n8 5 0\n" + cube_corners + cube_sides);
  write("empty.off", "OFF\n0 0 0\n");
  write("nonsense.off", "this is no surface\n");
  write("nonsense.txt", "this is no surface\n");
  // inward orientation, another format
  write("inward.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");

  // 2 x 2 x 2 about the origin, 45 degrees about z, shifted
  const Shape<3> cube = make<3>("set Shape = triangle mesh\nset File = cube.off\n"
                                "set Centre at origin = true\nset Scale = 2\n"
                                "set Rotation angle = 45\nset Translation = 0.5, 0.5, 1");
  const Shape<3> box =
    make<3>("set Shape = box\nset Lower corner = -1, -1, -1\nset Upper corner = 1, 1, 1");
  double error = 0;
  for (unsigned int sample = 0; sample < 1000; ++sample)
    {
      const Point<3> x = random_point<3>();
      const double   c = std::sqrt(0.5), u = x[0] - 0.5, v = x[1] - 0.5;
      error = std::max(error,
                       std::abs(cube.signed_distance(x) -
                                box.signed_distance(
                                  Point<3>(c * (u + v), c * (v - u), x[2] - 1))));
    }
  tests::out() << "turned cube against box: " << (error < 1e-11 ? 0. : error)
               << std::endl;

  // any shape is put where a triangle mesh would be
  const std::string put =
    "set Scale = 0.7\nset Rotation axis = 1, 2, 3\nset Rotation angle = 50\nset Translation = 0.2, 0.3, 0.4\n";
  const Shape<3> put_cube = make<3>("set Shape = triangle mesh\nset File = cube.off\n" + put);
  const Shape<3> put_box =
    make<3>("set Shape = box\nset Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 1\n" + put);
  error = 0;
  for (unsigned int sample = 0; sample < 1000; ++sample)
    {
      const Point<3> x = random_point<3>();
      error            = std::max(error, std::abs(put_cube.signed_distance(x) - put_box.signed_distance(x)));
    }
  tests::out() << "placed cube against box: " << (error < 1e-11 ? 0. : error) << std::endl;

  const TriangleSurface surface("cube.off", Placement(), "here");
  const auto            corners = surface.bounding_box().get_boundary_points();
  tests::out() << "cube: " << surface.n_vertices() << " vertices, "
               << surface.n_triangles() << " triangles, " << corners.first << " to "
               << corners.second << std::endl;
  show<3>("set Shape = triangle mesh\nset File = inward.obj",
          {{0.1, 0.2, 0.2}, {-0.3, 0.2, 0.2}, {1, 1, 1}, {0, 0, 0}});

  for (const std::string name :
       {"missing.off", "open.off", "empty.off", "nonsense.off", "nonsense.txt"})
    show_error<3>("set Shape = triangle mesh\nset File = " + name);
}

/// What is known within a reach is the distance, and beyond it has its sign and lies between.
void
check_reach()
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> coordinate(-1, 2);
  for (const std::string invert : {"false", "true"})
    {
      const Shape<3> cube =
        make<3>("set Shape = triangle mesh\nset File = cube.off\nset Rotation angle = 30\nset Invert = " + invert);
      unsigned int n_wrong = 0, n_exact = 0, n_short = 0;
      Point<3>     x;
      for (unsigned int k = 0; k < 20000; ++k)
        {
          // every second one beside the one before, so that some are in the same cube
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = k % 2 == 0 ? coordinate(random) : x[d] + 1e-3 * coordinate(random);
          const double exact = cube.signed_distance(x);
          for (const double reach : {1e-12, 0.05, 0.4})
            {
              const double within = cube.distance_within(x, reach);
              const bool   is_near = std::abs(exact) < reach;
              n_wrong += is_near ? std::abs(within - exact) > 1e-14 :
                                   within * exact <= 0 || std::abs(within) < reach - 1e-14 ||
                                     std::abs(within) > std::abs(exact) + 1e-14;
              n_exact += is_near;
              n_short += std::abs(within) < 0.99 * std::abs(exact);
            }
        }
      tests::out() << "within a reach: " << n_wrong << " wrong, some exact " << (n_exact > 1000) << ", many shorter "
                   << (n_short > 10000) << std::endl;
    }
}

template <int dim>
void
check_errors()
{
  for (const std::string text :
       {"set Radius = 0",
        "set Shape = box\nset Lower corner = 1, 0, 0",
        "set Shape = cylinder\nset Axis = 0, 0, 0",
        "set Shape = cylinder\nset Length = -1",
        "set Shape = torus\nset Minor radius = 0.3",
        "set Shape = half space\nset Normal = 0, 0, 0",
        "set Shape = triangle mesh",
        "set Shape = triangle mesh\nset File = cube.off\nset Scale = 0",
        "set Shape = triangle mesh\nset File = cube.off\nset Rotation axis = 0, 0, 0",
        "set Shape = box\nset Scale = -1",
        "set Centre at origin = true",
        "set Shape = expression",
        "set Shape = expression\nset Expression = x + foo",
        "set Shape = expression\nset Expression = sqrt(x",
        "set Shape = expression\nset Expression = x - t"})
    show_error<dim>(text);
}

void
start(const int, char **)
{

  tests::out() << "dimension 2" << std::endl;
  const std::vector<Point<2>> p2 = {{0.5, 0.5}, {0.9, 0.9}, {0.5, 0.1}, {0.35, 0.6}};
  show<2>("", p2);
  show<2>(
    "set Shape = sphere\nset Centre = 0.1, 0.2\nset Radius = 0.5\nset Invert = true", p2);
  show<2>("set Shape = box", p2);
  show<2>("set Shape = cylinder\nset Axis = 1, 1\nset Radius = 0.1", p2);
  show<2>("set Shape = capsule\nset Radius = 0.1", p2);
  show<2>("set Shape = box\nset Lower corner = 0, 0\nset Upper corner = 2, 1\nset Scale = 0.25\n"
          "set Rotation angle = 90\nset Translation = 0.5, 0.5",
          p2);
  show<2>("set Shape = torus", p2);
  show<2>("set Shape = half space\nset Normal = 3, 4", p2);
  show<2>("set Shape = expression\nset Expression = max(x - 0.6, -y) + 0*pi", p2);
  show_error<2>("set Shape = triangle mesh\nset File = cube.off");

  tests::out() << "dimension 3" << std::endl;
  const std::vector<Point<3>> p3 = {{0.5, 0.5, 0.5},
                                    {0.9, 0.9, 0.9},
                                    {0.5, 0.5, 0.1},
                                    {0.35, 0.6, 0.5}};
  show<3>("", p3);
  show<3>("set Shape = box\nset Upper corner = 1, 1, 1\nset Invert = true", p3);
  show<3>("set Shape = cylinder\nset Axis = 1, 1, 0\nset Radius = 0.1", p3);
  show<3>("set Shape = capsule\nset Start = 0.5, 0.5, 0.5\nset End = 0.5, 0.5, 0.5", p3);
  show<3>("set Shape = torus\nset Axis = 0, 2, 0", p3);
  show<3>("set Shape = half space", p3);
  show<3>("set Shape = expression\nset Expression = if(x < 0.4, -1, 1) + 0.5", p3);
  show<3>("set Shape = expression\nset Expression = -2.5", p3);
  check_triangle_mesh();
  check_reach();
  check_errors<3>();
}

const Test test("geometry/shapes", start);
} // namespace tests::geometry_shapes
