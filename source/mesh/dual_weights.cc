// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/geometry/simplex.h>
#include <treacle/mesh/dual_weights.h>

#include <algorithm>
#include <limits>
#include <numeric>

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

      /// The part in the cell of the face's vertices x and p, the one that is number @p last of vertex. Its dual centre has the same
      /// power |x - c|^2 - w for all of its vertices; in the face's plane that, less |x|^2, is linear.
      void
      add_side(const std::array<Point<dim>, dim> &x, const Point<dim> &p, const unsigned int last)
      {
        Simplex<dim> cell;
        std::copy(x.begin(), x.end(), cell.begin());
        cell[dim]                         = p;
        const Tensor<1, dim> up           = basis_gradients<dim>(cell)[dim];
        const double         height       = 1 / up.norm();
        const Point<dim>     foot         = p - height * height * up;
        const auto           at_foot      = barycentric_coordinates<dim>(cell, foot);
        double               power        = height * height;
        for (unsigned int k = 0; k < dim; ++k)
          {
            power -= at_foot[k] * (x[k] - foot).norm_square();
            slope[k] += at_foot[k] / (2 * height);
          }
        value += power / (2 * height);
        way += height / (dim + 1);
        slope[last] = -1 / (2 * height);
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

    /// The numbers of the dual lengths that the weight of each vertex changes.
    template <int dim>
    std::vector<std::vector<unsigned int>>
    changed_by(const std::vector<DualLength<dim>> &lengths, const unsigned int n_vertices)
    {
      std::vector<std::vector<unsigned int>> result(n_vertices);
      for (unsigned int i = 0; i < lengths.size(); ++i)
        for (const unsigned int vertex : lengths[i].vertex)
          result[vertex].push_back(i);
      return result;
    }

    /// Weights with which all are as long as this part of the way, or nearly.
    template <int dim>
    std::vector<double>
    relaxed(const std::vector<DualLength<dim>>           &lengths,
            const std::vector<std::vector<unsigned int>> &by_vertex,
            const std::vector<double>                    &bounds,
            const double                                  part)
    {
      std::vector<double>       weights(bounds.size(), 0.);
      std::vector<unsigned int> to_look_at(lengths.size());
      std::iota(to_look_at.begin(), to_look_at.end(), 0);
      for (unsigned int sweep = 0; sweep < most_sweeps && !to_look_at.empty(); ++sweep)
        {
          std::vector<unsigned int> next;
          for (const unsigned int i : to_look_at)
            if (lengths[i].with(weights) < part * lengths[i].way)
              {
                lengths[i].set(more * part * lengths[i].way, bounds, weights);
                for (const unsigned int vertex : lengths[i].vertex)
                  next.insert(next.end(), by_vertex[vertex].begin(), by_vertex[vertex].end());
              }
          std::sort(next.begin(), next.end());
          next.erase(std::unique(next.begin(), next.end()), next.end());
          to_look_at = std::move(next);
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
    const auto                         by_vertex = changed_by(lengths, bounds.size());
    double                             lacks     = shortage(lengths, best);
    for (unsigned int round = 0; round < least.size() + most_rounds; ++round)
      {
        const double              part    = round < least.size() ? least[round] : least.back();
        const std::vector<double> weights = relaxed(lengths, by_vertex, bounds, part);
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
