// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/nearest_point.h>

#include <algorithm>

namespace treacle
{
  /// Nearest point of a segment or triangle (Ericson 2005, section 5.1).
  Point<2>
  nearest_point(const std::array<Point<2>, 2> &x, const Point<2> &p)
  {
    const Tensor<1, 2> e = x[1] - x[0];
    const double       l = e * e;
    const double       t = l > 0 ? std::min(1., std::max(0., (p - x[0]) * e / l)) : 0.;
    return x[0] + t * e;
  }

  Point<3>
  nearest_point(const std::array<Point<3>, 3> &x, const Point<3> &p)
  {
    const Tensor<1, 3> ab = x[1] - x[0], ac = x[2] - x[0], ap = p - x[0];
    const double       d1 = ab * ap, d2 = ac * ap;
    if (d1 <= 0 && d2 <= 0)
      return x[0];
    const Tensor<1, 3> bp = p - x[1];
    const double       d3 = ab * bp, d4 = ac * bp;
    if (d3 >= 0 && d4 <= d3)
      return x[1];
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
      return x[0] + (d1 > d3 ? d1 / (d1 - d3) : 0.) * ab;
    const Tensor<1, 3> cp = p - x[2];
    const double       d5 = ab * cp, d6 = ac * cp;
    if (d6 >= 0 && d5 <= d6)
      return x[2];
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
      return x[0] + (d2 > d6 ? d2 / (d2 - d6) : 0.) * ac;
    const double va = d3 * d6 - d5 * d4;
    const double d43 = d4 - d3, d56 = d5 - d6;
    if (va <= 0 && d43 >= 0 && d56 >= 0)
      return x[1] + (d43 + d56 > 0 ? d43 / (d43 + d56) : 0.) * (x[2] - x[1]);
    const double sum = va + vb + vc;
    return x[0] + (vb / sum) * ab + (vc / sum) * ac;
  }
} // namespace treacle
