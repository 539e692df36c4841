// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Rigid motions by position and by velocity: the same motion given both ways, about
// a fixed axis and in precession, and velocities against differences of positions.

#include <treacle/base/exceptions.h>
#include <treacle/geometry/motion.h>

#include "../tests.h"

namespace tests::geometry_motion
{
using namespace treacle;

template <int dim>
using Parameters = typename RigidMotion<dim>::Parameters;

template <int dim>
Point<dim>
some_point()
{
  Point<dim> x;
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = 0.3 + 0.4 * d;
  return x;
}

std::string
size(const double x)
{
  return x < 1e-9 ? "below 1e-9" : x < 1e-6 ? "below 1e-6" : std::to_string(x);
}

/// The pose at t = 2 of one motion given in two ways.
template <int dim>
void
compare(const std::string &name, const Parameters<dim> &a, const Parameters<dim> &b)
{
  const RigidMotion<dim> motion_a(a, "A"), motion_b(b, "B");
  const Point<dim>       x = some_point<dim>();
  const Pose<dim>        p = motion_a.at(2), q = motion_b.at(2);
  const double           delta = 1e-4;
  const Tensor<1, dim>   difference =
    (motion_b.at(2 + delta).now(x) - motion_b.at(2 - delta).now(x)) / (2 * delta);
  tests::out() << name << ": place " << size((p.now(x) - q.now(x)).norm()) << ", way back "
               << size((q.at_start(q.now(x)) - x).norm()) << ", velocity "
               << size((p.velocity_at(p.now(x)) - q.velocity_at(q.now(x))).norm())
               << ", against differences "
               << size((difference - q.velocity_at(q.now(x))).norm()) << ", moved by "
               << (p.now(x) - x).norm() << std::endl;
}

template <int dim>
void
show_error(const Parameters<dim> &prm)
{
  try
    {
      RigidMotion<dim>(prm, "Solid 1").at(1);
      tests::out() << "no error" << std::endl;
    }
  catch (const UserError &error)
    {
      tests::out() << error.what() << std::endl;
    }
}

/// A vibration of 50 Hz and amplitude 1, given by its velocity; and a velocity that jumps.
void
check_integration()
{
  const std::string    w = "2*pi*50";
  const RigidMotion<2> vibration({{}, "0; 0", "0", w + "*cos(" + w + "*t); 0", w + "*cos(" + w + "*t)"},
                                 "vibration");
  double               error = 0;
  for (const double t : {9.9975, 10., 0.0033, 1.2345, 3.3333})
    {
      const Pose<2> &pose  = vibration.at(t);
      const double   exact = std::sin(2 * numbers::PI * 50 * t);
      error = std::max({error,
                        std::abs(pose.shift[0] - exact),
                        std::abs(pose.rotation[0][0] - std::cos(exact)),
                        std::abs(pose.rotation[1][0] - std::sin(exact))});
    }
  const RigidMotion<2> again({{}, "0; 0", "0", w + "*cos(" + w + "*t); 0", w + "*cos(" + w + "*t)"},
                             "vibration");
  tests::out() << "50 Hz for 10 s: off by " << size(error) << ", the same when asked at once "
               << (again.at(3.3333).shift == vibration.at(3.3333).shift ? "yes" : "no")
               << std::endl;
  const RigidMotion<2> jump({{}, "0; 0", "0", "if(t < 0.7, 1, 0); 0", "0"}, "jump");
  tests::out() << "a jump: off by " << size(std::abs(jump.at(5).shift[0] - 0.7)) << std::endl;
}

void
start(const int, char **)
{
  compare<2>("2D",
             {{0.1, 0.2}, "0.5*t^2; sin(t)", "0.3*t^2", "0; 0", "0"},
             {{0.1, 0.2}, "0; 0", "0", "t; cos(t)", "0.6*t"});
  compare<3>("3D",
             {{0.1, 0.2, 0.3}, "t; 0; sin(t)", "0; 0.3*t^2; 0", "0; 0; 0", "0; 0; 0"},
             {{0.1, 0.2, 0.3}, "0; 0; 0", "0; 0; 0", "1; 0; cos(t)", "0; 0.6*t; 0"});

  compare<2>("no derivative before 0",
             {{0.1, 0.2}, "0.1*t^1.5; 0", "0", "0; 0", "0"},
             {{0.1, 0.2}, "0; 0", "0", "0.15*sqrt(t); 0", "0"});
  check_integration();

  // R = Rz(a t) Rx(b t): the angular velocity is a z + Rz(a t) b x
  const RigidMotion<3> motion(
    {{}, "0; 0; 0", "0; 0; 0", "0; 0; 0", "0.7*cos(1.3*t); 0.7*sin(1.3*t); 1.3"}, "precession");
  const double   t = 2, a = 1.3 * t, b = 0.7 * t;
  const Point<3> x = some_point<3>();
  const Point<3> tilted(x[0], std::cos(b) * x[1] - std::sin(b) * x[2], std::sin(b) * x[1] + std::cos(b) * x[2]);
  const Point<3> turned(std::cos(a) * tilted[0] - std::sin(a) * tilted[1],
                        std::sin(a) * tilted[0] + std::cos(a) * tilted[1],
                        tilted[2]);
  tests::out() << "precession: place " << size((motion.at(t).now(x) - turned).norm()) << std::endl;

  show_error<2>({{}, "t; 0", "0", "1; 0", "0"});
  show_error<2>({{}, "1/t; 0", "0", "0; 0", "0"});
  show_error<2>({{}, "0; 0", "log(-t)", "0; 0", "0"});
  show_error<3>({{}, "0; 0; 0", "1", "0; 0; 0", "0; 0; 0"});
}

const Test test("geometry/motion", start);
} // namespace tests::geometry_motion
