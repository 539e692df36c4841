// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_mesh_files_h
#define treacle_tests_mesh_files_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
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
} // namespace tests

#endif
