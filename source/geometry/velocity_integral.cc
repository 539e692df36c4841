// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/velocity_integral.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace treacle
{
  namespace
  {
    /// Panels are as long as this (s), or this part of the time since 0 if that is more.
    constexpr double shortest_panel = 1. / 128, relative_panel = 1. / 16384;

    double
    panel_end(const double begin)
    {
      return begin + std::max(shortest_panel, relative_panel * begin);
    }

    /// They are halved until halving changes the shift by less than this part of the path,
    /// and the angle likewise; or so often, where a velocity jumps.
    constexpr double       kept_error = 1e-11;
    constexpr unsigned int most_halvings = 16;

    /// What a time interval adds, by Gauss's two points in it.
    template <int n>
    struct Increment
    {
      Tensor<1, n> sum;
      double       tolerated; ///< error, with what the rounding of t brings
      Tensor<1, n> first, second; ///< values at the points

      template <typename Function>
      Increment(const Function &f, const double begin, const double end)
      {
        const double h = end - begin, offset = 0.5 / std::sqrt(3.);
        first          = f(begin + (0.5 - offset) * h);
        second         = f(begin + (0.5 + offset) * h);
        sum            = 0.5 * h * (first + second);
        tolerated      = kept_error * 0.5 * h * (first.norm() + second.norm()) +
                    1e-15 * end * (second - first).norm();
      }
    };

    /// Does the cubic through the values in both halves meet those in the whole? Where a
    /// velocity jumps the sums may agree by chance.
    template <int n>
    bool
    is_smooth(const Increment<n> &whole, const Increment<n> &half1, const Increment<n> &half2)
    {
      const double                      a = 0.25 * (1 - 1 / std::sqrt(3.)); // first of Gauss's points
      const std::array<double, 4>       x{{a, 0.5 - a, 0.5 + a, 1 - a}};
      const std::array<Tensor<1, n>, 4> f{{half1.first, half1.second, half2.first, half2.second}};
      Tensor<1, n>                      at_first, at_second;
      double                            size = 0;
      for (unsigned int i = 0; i < 4; ++i)
        {
          double weight = 1; // at 2a; by symmetry that at 1 - 2a of the opposite value
          for (unsigned int j = 0; j < 4; ++j)
            if (j != i)
              weight *= (2 * a - x[j]) / (x[i] - x[j]);
          at_first += weight * f[i];
          at_second += weight * f[3 - i];
          size = std::max(size, f[i].norm());
        }
      return (at_first - whole.first).norm() + (at_second - whole.second).norm() <= 1e-6 * size;
    }

    Tensor<2, 2>
    rotation_in(const Increment<1> &turn, const double)
    {
      return rotation_by(turn.sum);
    }

    /// By Magnus' series, whose second term vanishes for a fixed axis.
    Tensor<2, 3>
    rotation_in(const Increment<3> &turn, const double h)
    {
      return rotation_by(turn.sum +
                         std::sqrt(3.) / 12 * h * h * cross_product_3d(turn.second, turn.first));
    }

    /// Bring a displacement from one time to another, in a part of a panel that was halved so
    /// often.
    template <int dim>
    void
    integrate(const typename VelocityIntegral<dim>::Velocity &v,
              const typename VelocityIntegral<dim>::Spin     &w,
              const double                                    begin,
              const double                                    end,
              const unsigned int                              n_halvings,
              typename VelocityIntegral<dim>::Displacement   &displacement)
    {
      constexpr int n_rotations = Pose<dim>::n_rotations;

      const double                 middle = 0.5 * (begin + end);
      const Increment<dim>         path(v, begin, end), path1(v, begin, middle), path2(v, middle, end);
      const Increment<n_rotations> arc(w, begin, end), arc1(w, begin, middle), arc2(w, middle, end);
      const Tensor<1, dim>         shift = path1.sum + path2.sum;
      const Tensor<2, dim>         rotation =
        rotation_in(arc2, end - middle) * rotation_in(arc1, middle - begin);

      constexpr double rounding = 4e-15; // of the entries of a rotation
      const bool       is_exact =
        is_smooth(path, path1, path2) && is_smooth(arc, arc1, arc2) &&
        (shift - path.sum).norm() <= path.tolerated &&
        (rotation - rotation_in(arc, end - begin)).norm() <= arc.tolerated + rounding;
      if (is_exact || n_halvings == most_halvings)
        {
          displacement.first += shift;
          displacement.second = rotation * displacement.second;
          return;
        }
      integrate<dim>(v, w, begin, middle, n_halvings + 1, displacement);
      integrate<dim>(v, w, middle, end, n_halvings + 1, displacement);
    }
  } // namespace

  template <int dim>
  typename VelocityIntegral<dim>::Displacement
  VelocityIntegral<dim>::at(const double t, const Velocity &velocity, const Spin &spin)
  {
    while (panel_end(times.back()) <= t)
      {
        const double begin        = times.back();
        Displacement displacement = displacements.back();
        integrate<dim>(velocity, spin, begin, panel_end(begin), 0, displacement);
        times.push_back(panel_end(begin));
        displacements.push_back(displacement);
      }
    // the last panel that begins at t or before, whatever was asked for earlier
    const auto   panel  = std::upper_bound(times.begin(), times.end(), t) - times.begin() - 1;
    Displacement result = displacements[panel];
    if (t > times[panel])
      integrate<dim>(velocity, spin, times[panel], t, 0, result);
    return result;
  }

  template class VelocityIntegral<2>;
  template class VelocityIntegral<3>;
} // namespace treacle
