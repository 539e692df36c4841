// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_solvers_conjugate_residuals_h
#define treacle_solvers_conjugate_residuals_h

#include <cmath>
#include <functional>
#include <list>
#include <optional>

namespace treacle
{
  /// Generalised conjugate residuals, truncated: Orthomin (Vinsome 1976; Saad, Iterative methods for
  /// sparse linear systems, 2003, 6.9), for a matrix K that need not be definite. The residual is the
  /// least in a norm that the preconditioner brings: as `l = L r` and `y = D l`, D symmetric and positive,
  /// its square is l·y; the next direction is a multiple of y by component. Each is made orthogonal
  /// to the last few alone, which loses next to nothing where K is symmetric.
  template <typename VectorType>
  class ConjugateResiduals
  {
  public:
    /// Sets its first argument to a linear map of the second.
    using Operator = std::function<void(VectorType &, const VectorType &)>;
    /// Turns a residual r into L r and sets the first argument to D L r.
    using Measure = std::function<void(VectorType &, VectorType &)>;
    /// Turns D L r into the direction in which to go.
    using Turn = std::function<void(VectorType &)>;

    /// Is it done, by L r and D L r of the residual?
    using Test = std::function<bool(const VectorType &, const VectorType &)>;

    ConjugateResiduals(const Operator &matrix, const Measure &measure, const Turn &turn)
      : matrix(matrix)
      , measure(measure)
      , turn(turn)
    {}

    /// Improve x until it is done. Returns the number of iterations, nothing where it takes more than
    /// @p most. Collective.
    std::optional<unsigned int>
    solve(VectorType &x, const VectorType &b, const Test &is_done, const unsigned int most) const
    {
      VectorType l(b), y(b);
      matrix(l, x);
      l.sadd(-1, 1, b);
      measure(y, l);
      Direction              d{b, b, b};
      std::list<Direction> last;
      for (unsigned int k = 0;; ++k)
        {
          if (is_done(l, y))
            return k;
          if (k == most)
            return {};
          d.step = y;
          turn(d.step);
          matrix(d.l, d.step);
          measure(d.y, d.l);
          for (const Direction &other : last)
            d.add(-(d.l * other.y), other);
          const double norm = std::sqrt(d.l * d.y);
          if (!(norm > 0)) // no step changes the residual
            return {};
          d.scale(1 / norm);
          const double length = d.y * l;
          x.add(length, d.step);
          l.add(-length, d.l);
          y.add(-length, d.y);
          if (last.size() < (k < many ? n_last : n_last_of_many))
            last.push_back(d);
          else
            {
              last.splice(last.end(), last, last.begin());
              last.back().swap(d);
            }
        }
    }

  private:
    /// Directions that a new one is made orthogonal to, and where a solve has taken many iterations.
    static constexpr unsigned int n_last = 10, n_last_of_many = 60, many = 30;

    /// A step of x, and what it does to the residual.
    struct Direction
    {
      VectorType step, l, y;

      void
      add(const double factor, const Direction &other)
      {
        step.add(factor, other.step);
        l.add(factor, other.l);
        y.add(factor, other.y);
      }

      void
      scale(const double factor)
      {
        step *= factor;
        l *= factor;
        y *= factor;
      }

      void
      swap(Direction &other)
      {
        step.swap(other.step);
        l.swap(other.l);
        y.swap(other.y);
      }
    };

    const Operator matrix;
    const Measure  measure;
    const Turn     turn;
  };
} // namespace treacle

#endif
