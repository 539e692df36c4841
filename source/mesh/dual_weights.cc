// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/simplex.h>
#include <treacle/mesh/dual_weights.h>

#include <algorithm>
#include <limits>

namespace treacle
{
  namespace
  {
    /// Parts of the way between barycentres to try, and how much longer what is shorter gets.
    constexpr std::array<double, 3> least = {{0.1, 0.03, 1.2 * least_dual_length}};
    constexpr double                more  = 1.3;
    /// Largest weight, in squares of the shortest edge of a vertex (the lattice has up to 0.05): dual centres stay beside their cells.
    constexpr double       largest     = 0.05;
    constexpr unsigned int most_sweeps = 100, most_rounds = 5;

    /// The dual length over an inner face, value + sum slope w (m).
    template <int dim>
    struct DualLength
    {
      double                            value = 0, way = 0; // way: between barycentres, along the normal
      std::array<unsigned int, dim + 2> vertex{};           // of the face, then the two opposite
      std::array<double, dim + 2>       slope{};

      double
      with(const std::vector<double> &weights) const
      {
        double length = value;
        for (unsigned int k = 0; k < dim + 2; ++k)
          length += slope[k] * weights[vertex[k]];
        return length;
      }

      /// The smallest change that makes it so long, if no weight gets larger than @p bounds.
      void
      set(const double length, const std::vector<double> &bounds, std::vector<double> &weights) const
      {
        double square = 0;
        for (const double s : slope)
          square += s * s;
        const double change = (length - with(weights)) / square;
        for (unsigned int k = 0; k < dim + 2; ++k)
          {
            double &w = weights[vertex[k]];
            w         = std::clamp(w + change * slope[k], -bounds[vertex[k]], bounds[vertex[k]]);
          }
      }

      /// The part in the cell of the face's vertices x and p, the one that is number @p last of vertex: the dual centre's way from the face towards p,
      /// weighted_circumcentre() along the normal.
      void
      add_side(const std::array<Point<dim>, dim> &x, const Point<dim> &p, const unsigned int last)
      {
        Simplex<dim> cell;
        std::copy(x.begin(), x.end(), cell.begin());
        cell[dim]                   = p;
        const auto           g      = basis_gradients<dim>(cell);
        const Tensor<1, dim> normal = g[dim] / g[dim].norm();
        for (unsigned int k = 0; k < dim; ++k)
          slope[k] -= 0.5 * (g[k] * normal);
        slope[last] = -0.5 * (g[dim] * normal);
        value += (weighted_circumcentre<dim>(cell, {}) - x[0]) * normal;
        way += 1 / ((dim + 1) * g[dim].norm());
      }
    };

    template <int dim>
    std::vector<DualLength<dim>>
    dual_lengths(const MeshFile<dim> &file)
    {
      std::vector<DualLength<dim>> lengths;
      for (unsigned int c = 0; c < file.cells.size(); ++c)
        for (unsigned int v = 0; v <= dim; ++v)
          if (const unsigned int other = file.neighbours[c][v]; other != invalid && c < other)
            {
              const auto    &beyond   = file.neighbours[other];
              const unsigned opposite = std::find(beyond.begin(), beyond.end(), c) - beyond.begin();
              DualLength<dim>             length;
              std::array<Point<dim>, dim> x;
              for (unsigned int k = 0, i = 0; k <= dim; ++k)
                if (k != v)
                  {
                    length.vertex[i] = file.cells[c][k];
                    x[i++]           = file.vertices[file.cells[c][k]];
                  }
              length.vertex[dim]     = file.cells[c][v];
              length.vertex[dim + 1] = file.cells[other][opposite];
              for (const unsigned int last : {dim, dim + 1})
                length.add_side(x, file.vertices[length.vertex[last]], last);
              lengths.push_back(length);
            }
      return lengths;
    }

    template <int dim>
    std::vector<double>
    bounds_of_weights(const MeshFile<dim> &file)
    {
      std::vector<double> bounds(file.vertices.size(), std::numeric_limits<double>::max());
      for (const auto &cell : file.cells)
        for (const unsigned int a : cell)
          for (const unsigned int b : cell)
            if (a != b)
              bounds[a] = std::min(bounds[a], largest * (file.vertices[a] - file.vertices[b]).norm_square());
      return bounds;
    }

    /// By how much dual lengths are too short (m), all in all.
    template <int dim>
    double
    shortage(const std::vector<DualLength<dim>> &lengths, const std::vector<double> &weights)
    {
      double sum = 0;
      for (const auto &length : lengths)
        sum += std::max(0., least_dual_length * length.way - length.with(weights));
      return sum;
    }

    /// Weights with which all are as long as this part of the way, or nearly.
    template <int dim>
    std::vector<double>
    relaxed(const std::vector<DualLength<dim>> &lengths, const std::vector<double> &bounds, const double part)
    {
      std::vector<double> weights(bounds.size(), 0.);
      bool                is_done = false;
      for (unsigned int sweep = 0; sweep < most_sweeps && !is_done; ++sweep)
        {
          is_done = true;
          for (const auto &length : lengths)
            if (length.with(weights) < part * length.way)
              {
                length.set(more * part * length.way, bounds, weights);
                is_done = false;
              }
        }
      return weights;
    }
  } // namespace

  template <int dim>
  std::vector<double>
  dual_weights(const MeshFile<dim> &file)
  {
    const std::vector<DualLength<dim>> lengths = dual_lengths(file);
    std::vector<double>                bounds  = bounds_of_weights(file), best(bounds.size(), 0.);
    double                             lacks   = shortage(lengths, best);
    for (unsigned int round = 0; round < least.size() + most_rounds; ++round)
      {
        const double              part    = round < least.size() ? least[round] : least.back();
        const std::vector<double> weights = relaxed(lengths, bounds, part);
        const double              now     = shortage(lengths, weights);
        if (now <= lacks)
          {
            best  = weights;
            lacks = now;
          }
        if (now == 0)
          break;
        if (round + 1 >= least.size()) // the others may still get long enough without those around what does not
          for (const auto &length : lengths)
            if (length.with(weights) < least_dual_length * length.way)
              for (const unsigned int vertex : length.vertex)
                bounds[vertex] = 0;
      }
    return best;
  }

  template std::vector<double>
  dual_weights(const MeshFile<2> &);
  template std::vector<double>
  dual_weights(const MeshFile<3> &);
} // namespace treacle
