// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// What a scene says after its subsections were parsed, and how it refuses.

#include <treacle/base/exceptions.h>
#include <treacle/scene/bodies.h>
#include <treacle/scene/scene.h>

#include <fstream>
#include <random>

#include "../tests.h"

namespace tests::scene_scene
{
using namespace treacle;

template <int dim>
Scene<dim>
make(const std::string &text,
     const unsigned int n_liquids = 1,
     const unsigned int n_solids  = 0,
     const unsigned int n_emitters = 0)
{
  ParameterHandler                prm;
  typename Scene<dim>::Parameters parameters;
  parameters.add_parameters(prm, n_liquids, n_solids, n_emitters);
  prm.parse_input_from_string(text);
  return Scene<dim>(parameters);
}

std::string
in(const std::string &subsection, const std::string &entry)
{
  return "subsection " + subsection + "\nset " + entry + "\nend\n";
}

template <int dim>
void
show_error(const std::string &text, const unsigned int n_liquids = 1)
{
  try
    {
      make<dim>(text, n_liquids);
      tests::out() << "no error: " << text << std::endl;
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

/// Of many emitters the nearest is found among few; all are asked here.
template <int dim>
void
show_many_emitters()
{
  constexpr unsigned int n = 12;
  std::string            text;
  for (unsigned int k = 0; k < n; ++k)
    {
      const std::string x = std::to_string(0.1 + 0.07 * k), y = std::to_string(0.1 + 0.5 * (k % 3) / 2.);
      text += "subsection Emitter " + std::to_string(k + 1) + "\n" +
              (k == 5 ? "set Shape = expression\nset Expression = 30*(abs(x - 0.9) - 0.02)" :
                        "set Radius = 0.03\nset Centre = " + x + ", " + y + (dim == 3 ? ", " + y : "")) +
              "\nset Start time = " + std::to_string(k % 4) + "\nset Stop time = " + std::to_string(3 + k % 2) + "\nend\n";
    }
  const Scene<dim>                       scene = make<dim>(text, 1, 0, n);
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> coordinate(-0.1, 1.1);
  unsigned int                           n_wrong = 0;
  for (unsigned int k = 0; k < 20000; ++k)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = coordinate(random);
      const double time    = k / 2500;
      double       nearest = far_away;
      for (const Emitter<dim> &emitter : scene.emitters())
        if (emitter.is_at_work(time))
          nearest = std::min(nearest, emitter.signed_distance(x));
      n_wrong += scene.emitter_distance(x, time) != nearest;
    }
  tests::out() << dim << "D, " << n << " emitters: nearest one wrong at " << n_wrong << " of 20000 points" << std::endl;
}

/// Of several bodies of triangles those are not asked whose boxes are farther off than the nearest; all are asked here.
void
show_many_surfaces(const bool is_last_inverted)
{
  std::ofstream("wedge.off") << "OFF\n4 4 0\n0 0 0\n.2 0 0\n0 .3 0\n0 0 .1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  constexpr unsigned int n = 5;
  std::string            liquids, solids;
  std::vector<Shape<3>>  shapes;
  for (unsigned int k = 0; k < n; ++k)
    {
      const std::string shape =
        k == 1 ? "set Radius = 0.1\n" :
                 "set Shape = triangle mesh\nset File = wedge.off\nset Rotation angle = " + std::to_string(50 * k) +
                   "\nset Translation = " + std::to_string(0.2 * (k / 2 + 1)) + ", " + std::to_string(0.25 * (k % 2 + 1)) +
                   ", 0.4\nset Invert = " + (k == 4 && is_last_inverted ? "true" : "false") + "\n";
      liquids += "subsection Liquid " + std::to_string(k + 1) + "\n" + shape + "set Velocity = " + std::to_string(k) +
                 "; 0; 0\nend\n";
      solids += "subsection Solid " + std::to_string(k + 1) + "\n" + shape +
                (k == 2 ? "set Velocity = 0.1; 0; 0.2\n" : "") + "end\n";
      ParameterHandler            prm;
      typename Shape<3>::Parameters parameters;
      parameters.add_parameters(prm);
      prm.parse_input_from_string(shape);
      shapes.emplace_back(parameters, "a body", 1e-12);
    }
  const Scene<3>                         scene = make<3>(liquids + solids, n, n);
  const double                           time  = 0.5;
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> coordinate(-0.1, 1.1);
  unsigned int                           n_wrong = 0, n_inside = 0;
  for (unsigned int k = 0; k < 5000; ++k)
    {
      const Point<3>      x(coordinate(random), coordinate(random), coordinate(random));
      std::vector<double> distances, from_solids;
      for (unsigned int i = 0; i < n; ++i)
        {
          distances.push_back(shapes[i].signed_distance(x));
          from_solids.push_back(i == 2 ? shapes[i].signed_distance(x - time * Tensor<1, 3>({0.1, 0, 0.2})) : distances[i]);
          n_wrong += (scene.side_of_liquid(i, x) < 0) != (distances[i] < 0);
          n_inside += distances[i] < 0;
        }
      const auto   least = std::min_element(distances.begin(), distances.end());
      const auto   last  = std::find_if(distances.rbegin(), distances.rend(), [](const double d) { return d < 0; });
      const auto   owner = last == distances.rend() ? least : std::prev(last.base()); // the last around x, or the nearest
      const double nearest_solid = *std::min_element(from_solids.begin(), from_solids.end());
      n_wrong += scene.liquid_distance(x) != *least || scene.initial_velocity(x)[0] != owner - distances.begin() ||
                 std::abs(scene.solid_distance(x, time) - nearest_solid) > 1e-12;
    }
  tests::out() << n << " surfaces, of 5000 points " << n_inside << " inside: wrong " << n_wrong << std::endl;
}

template <int dim>
void
show_walls(const std::string &condition)
{
  const Scene<dim> scene = make<dim>(in("Domain", "Wall condition = " + condition));
  tests::out() << condition << " ->";
  for (unsigned int side = 0; side < 2 * dim; ++side)
    tests::out() << (scene.no_slip(side) ? " no" : " free");
  tests::out() << std::endl;
}

template <int dim>
void
show_defaults()
{
  const Scene<dim> scene = make<dim>("");
  const Point<dim> x     = diagonal_point<dim>(0.5);
  tests::out() << "dimension " << dim << std::endl
               << "box " << scene.lower_corner() << " to " << scene.upper_corner()
               << std::endl
               << "liquid " << scene.liquid_distance(x) << ", velocity "
               << scene.initial_velocity(x) << std::endl
               << "solid " << scene.has_solids() << ' '
               << (scene.solid_distance(x, 0.) > 1e10) << std::endl
               << "material " << scene.density(x, 0.) << ' ' << scene.viscosity(x, 0.)
               << ", gravity " << scene.gravity(x, 0.) << std::endl;
}

void
show_rich_scene()
{
  // a copy, so that the original's parameters and parsers are gone
  const Scene<3> scene =
    make<3>(in("Domain", "Lower corner = -1, -2, -3") +
              in("Material", "Density = 1000 + 10*z") +
              in("Material", "Viscosity = (x >= 0 && x == x) ? 2*max(pi, 1) : exp(-t)") +
              in("Gravity", "Acceleration = sin(pi*t); 2; if(x < 0, -z, t)") +
              in("Liquid 1", "Centre = 0, 0, 0") +
              in("Liquid 1", "Velocity = -y + 0.1; x; t + 3") +
              in("Liquid 2", "Shape = box") + in("Liquid 2", "Velocity = 7; 8; 9") +
              in("Solid 1", "Shape = half space") + in("Solid 1", "Centre = 0, 0, -1") +
              in("Solid 2", "Invert = true") + in("Solid 2", "Radius = 3"),
            2,
            2);
  tests::out() << "rich scene, box from " << scene.lower_corner() << std::endl;
  for (const Point<3> &x : {Point<3>(0.1, 0.2, 0.3), Point<3>(-0.1, 0.6, 0.6)})
    for (const double t : {0., 0.5})
      tests::out() << scene.liquid_distance(x) << " | " << scene.initial_velocity(x)
                   << " | " << scene.solid_distance(x, t) << " | "
                   << scene.solid_velocity(x, t) << " | " << scene.density(x, t) << " | "
                   << scene.viscosity(x, t) << " | " << scene.gravity(x, t) << std::endl;

  const Scene<2> negative = make<2>(in("Material", "Density = x"));
  try
    {
      negative.density(Point<2>(-1, 0), 0.);
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

void
start(const int, char **)
{

  show_defaults<2>();
  show_defaults<3>();
  show_rich_scene();

  tests::out() << "walls" << std::endl;
  show_walls<2>("free slip");
  show_walls<2>("top: free slip");
  show_walls<3>("no slip");
  show_walls<3>("default: no slip; left, right: free slip");
  show_walls<3>("default: free slip ; front,top:no slip;");
  show_walls<3>("back: free slip; free slip; bottom: no slip");

  show_many_emitters<2>();
  show_many_emitters<3>();
  show_many_surfaces(false);
  show_many_surfaces(true);

  tests::out() << "errors" << std::endl;
  show_error<3>(in("Domain", "Wall condition = sticky"));
  show_error<3>(in("Domain", "Wall condition ="));
  show_error<2>(in("Domain", "Wall condition = front: no slip"));
  show_error<3>(in("Domain", "Wall condition = left, top: free slip; top: no slip"));
  show_error<3>(in("Domain", "Wall condition = no slip; default: free slip"));
  show_error<3>(in("Domain", "Upper corner = 1, 0, 1"));
  show_error<3>(in("Gravity", "Acceleration = 0; -9.81"));
  show_error<2>(in("Gravity", "Acceleration = 0; 0; -9.81"));
  show_error<2>(in("Gravity", "Acceleration = 0, -9.81"));
  show_error<2>(in("Liquid 1", "Velocity = 1; 2*q"));
  show_error<2>(in("Liquid 1", "Velocity = 1;; 2"));
  show_error<2>(in("Liquid 1", "Radius = -0.5"));
  show_error<2>(in("Material", "Density = 0"));
  show_error<3>(in("Material", "Density = water"));
  show_error<3>(in("Material", "Density = 0,5"));
  show_error<3>(in("Material", "Density = x=5"));
  show_error<3>(in("Material", "Viscosity = -1"));
  show_error<3>(in("Material", "Viscosity ="));
  show_error<3>("", 0);
}

const Test test("scene/scene", start);
} // namespace tests::scene_scene
