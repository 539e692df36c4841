// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_mesh_files_h
#define treacle_tests_mesh_files_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <random>
#include <string>
#include <vector>

namespace tests
{
  using dealii::Point;

  /// Write a mesh of triangles or tetrahedra as Gmsh's .msh, version 2.2.
  template <int dim>
  void
  write_msh(const std::string                                      &path,
            const std::vector<Point<dim>>                          &points,
            const std::vector<std::array<unsigned int, dim + 1>> &cells)
  {
    std::ofstream file(path);
    file << std::setprecision(17) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << points.size() << '\n';
    for (unsigned int i = 0; i < points.size(); ++i)
      file << i + 1 << ' ' << points[i] << (dim == 2 ? " 0\n" : "\n");
    file << "$EndNodes\n$Elements\n" << cells.size() << '\n';
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        file << c + 1 << (dim == 2 ? " 2" : " 4") << " 2 0 1";
        for (const unsigned int v : cells[c])
          file << ' ' << v + 1;
        file << '\n';
      }
    file << "$EndElements\n";
  }

  /// The unit box of n^dim cubes, each cut along its diagonal into dim! simplices. All
  /// those of a cube have one circumcentre: dual lengths are 0. With @p squeezed the box
  /// is compressed along the diagonal until the simplices are as round as can be, those
  /// of a body-centred lattice in 3D and equilateral in 2D: dual lengths are positive.
  /// @p jitter (in cube edges) moves inner vertices: some dual lengths are negative.
  template <int dim>
  void
  write_box(const std::string &path, const unsigned int n, const bool squeezed, const double jitter)
  {
    std::mt19937                           generator(5);
    std::uniform_real_distribution<double> random(-1, 1);
    std::vector<Point<dim>>                points;
    const auto                             n_points = [&](const unsigned int d) {
      return static_cast<unsigned int>(std::pow(n + 1, d) + 0.5);
    };
    const double factor = dim == 2 ? 1 / std::sqrt(3.) : 0.5;
    for (unsigned int i = 0; i < n_points(dim); ++i)
      {
        Point<dim> x;
        double     mean = 0;
        for (unsigned int d = 0, code = i; d < dim; ++d, code /= n + 1)
          {
            x[d] = (code % (n + 1)) / static_cast<double>(n);
            if (code % (n + 1) > 0 && code % (n + 1) < n)
              x[d] += jitter / n * random(generator);
            mean += x[d] / dim;
          }
        if (squeezed)
          for (unsigned int d = 0; d < dim; ++d)
            x[d] -= (1 - factor) * mean;
        points.push_back(x);
      }
    std::vector<std::array<unsigned int, dim + 1>> cells;
    for (unsigned int i = 0; i < n_points(dim); ++i)
      {
        bool is_cube = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_cube = is_cube && i / n_points(d) % (n + 1) < n;
        std::array<unsigned int, dim> axes;
        for (unsigned int d = 0; d < dim; ++d)
          axes[d] = d;
        do
          if (is_cube)
            {
              cells.emplace_back();
              cells.back()[0] = i;
              for (unsigned int k = 0; k < dim; ++k)
                cells.back()[k + 1] = cells.back()[k] + n_points(axes[k]);
            }
        while (std::next_permutation(axes.begin(), axes.end()));
      }
    write_msh<dim>(path, points, cells);
  }

  /// The unit box as a body-centred lattice of n^3 cubes. At its sides two tetrahedra that make half an octahedron have one
  /// circumcentre: the dual length between them, over a diagonal of corners with an even sum, is 0.
  inline void
  write_body_centred(const std::string &path, const unsigned int n)
  {
    std::vector<Point<3>> points;
    const auto            layer = [&](const unsigned int n_points, const double first) {
      for (unsigned int i = 0; i < n_points * n_points * n_points; ++i)
        points.emplace_back((first + i % n_points) / n, (first + i / n_points % n_points) / n, (first + i / n_points / n_points) / n);
    };
    layer(n + 1, 0);
    const unsigned int first_centre = points.size();
    layer(n, 0.5);
    const std::array<unsigned int, 3>              corner_step = {{1, n + 1, (n + 1) * (n + 1)}}, centre_step = {{1, n, n * n}};
    std::vector<std::array<unsigned int, 4>> cells;
    for (unsigned int cube = 0; cube < n * n * n; ++cube)
      for (unsigned int d = 0; d < 3; ++d)
        for (const bool upper : {false, true})
          {
            const std::array<unsigned int, 3> at     = {{cube % n, cube / n % n, cube / n / n}};
            const unsigned int                centre = first_centre + cube, a = corner_step[(d + 1) % 3], b = corner_step[(d + 2) % 3],
                               corner = at[0] + (at[1] + at[2] * (n + 1)) * (n + 1) + upper * corner_step[d];
            const std::array<unsigned int, 4> ring    = {{corner, corner + a, corner + a + b, corner + b}};
            const unsigned int                odd     = (at[0] + at[1] + at[2] + upper) % 2;
            const bool                        is_side = at[d] == (upper ? n - 1 : 0);
            if (is_side)
              for (const unsigned int k : {odd, odd + 2})
                cells.push_back({{centre, ring[k], ring[(k + 1) % 4], ring[(k + 2) % 4]}});
            else if (upper)
              for (unsigned int k = 0; k < 4; ++k)
                cells.push_back({{centre, centre + centre_step[d], ring[k], ring[(k + 1) % 4]}});
          }
    write_msh<3>(path, points, cells);
  }

  /// The unit square in rows of nearly equilateral triangles, of which n stand on the floor.
  inline void
  write_rows(const std::string &path, const unsigned int n)
  {
    const unsigned int                       n_rows = std::lround(2 * n / std::sqrt(3.));
    std::vector<Point<2>>                    points;
    std::vector<std::array<unsigned int, 3>> cells;
    std::vector<unsigned int>                row;
    for (unsigned int j = 0; j <= n_rows; ++j)
      {
        const std::vector<unsigned int> below  = row;
        const bool                      is_odd = j % 2 == 1;
        row.clear();
        for (unsigned int i = 0; i <= n + is_odd; ++i)
          {
            row.push_back(points.size());
            points.emplace_back(std::clamp((i - 0.5 * is_odd) / n, 0., 1.), j / static_cast<double>(n_rows));
          }
        if (below.empty())
          continue;
        for (unsigned int i = 0; i <= n; ++i) // of the row that has one point more
          {
            const std::vector<unsigned int> &more = is_odd ? row : below, &fewer = is_odd ? below : row;
            cells.push_back({{more[i], more[i + 1], fewer[i]}});
            if (i < n)
              cells.push_back({{fewer[i], fewer[i + 1], more[i + 1]}});
          }
      }
    write_msh<2>(path, points, cells);
  }
} // namespace tests

#endif
