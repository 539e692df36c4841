// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/gradients.h>
#include <treacle/fields/viscosity_jump.h>

namespace treacle
{
  namespace
  {
    /// Of the line through two points.
    Tensor<1, 2>
    normal_of(const std::vector<Point<2>> &x)
    {
      return cross_product_2d(x[1] - x[0]);
    }

    /// Of the plane through three points, or about four that come row by row of a quadrilateral's corners.
    Tensor<1, 3>
    normal_of(const std::vector<Point<3>> &x)
    {
      return x.size() == 3 ? cross_product_3d(x[1] - x[0], x[2] - x[0]) : cross_product_3d(x[3] - x[0], x[2] - x[1]);
    }

    /// Vertices on the two sides of a jump.
    template <int dim>
    class Sides
    {
    public:
      explicit Sides(const VertexValues<dim> &mu)
        : mu(mu)
      {
        const auto [lowest, highest] = std::minmax_element(mu.begin(), mu.end());
        ratio                        = *highest / *lowest;
        middle                       = std::sqrt(*lowest * *highest);
      }

      bool
      is_upper(const double viscosity) const
      {
        return viscosity > middle;
      }

      /// Are the vertices of a side alike?
      bool
      exist() const
      {
        const auto [lowest, highest] = std::minmax_element(mu.begin(), mu.end());
        return middle > 0 && std::all_of(mu.begin(), mu.end(), [&, lower = *lowest, upper = *highest](const double value) {
                 return (is_upper(value) ? upper / value : value / lower) <= std::pow(ratio, 0.3);
               });
      }

      /// The means of both.
      std::array<double, 2>
      viscosity() const
      {
        std::array<double, 2> sum{}, n{};
        for (const double value : mu)
          {
            sum[is_upper(value)] += value;
            ++n[is_upper(value)];
          }
        return {{sum[0] / n[0], sum[1] / n[1]}};
      }

      /// Of an edge from the lower to the upper side, the place with most of the change, found by halving.
      std::optional<Point<dim>>
      crossing(Point<dim> lower, Point<dim> upper, const std::function<double(const Point<dim> &)> &viscosity) const
      {
        constexpr unsigned int n_halvings = 40;
        double                 below = 0, above = 0;
        for (unsigned int k = 0; k < n_halvings; ++k)
          {
            const Point<dim> between = lower + 0.5 * (upper - lower);
            const double     value   = viscosity(between);
            (is_upper(value) ? upper : lower) = between;
            (is_upper(value) ? above : below) = value;
          }
        // all of the way the same on a side: that of the vertex
        const bool jumps = below == 0 || above == 0 || above >= std::pow(ratio, 0.7) * below;
        return jumps ? std::optional<Point<dim>>(lower) : std::nullopt;
      }

    private:
      const VertexValues<dim> &mu;
      double                   ratio, middle;
    };

    /// Distances from the plane with the normal @p n, of any length, through the mean of some points.
    template <int dim>
    VertexValues<dim>
    distances(const Simplex<dim> &x, const Tensor<1, dim> &n, const std::vector<Point<dim>> &points)
    {
      Point<dim> middle;
      for (const Point<dim> &point : points)
        middle += point / double(points.size());
      const double      size = (x[1] - x[0]).norm();
      VertexValues<dim> result;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          result[i] = (x[i] - middle) * n / n.norm();
          if (std::abs(result[i]) < 1e-7 * size)
            result[i] = 0; // not a sliver by roundoff
        }
      return result;
    }
  } // namespace

  template <int dim>
  std::optional<ViscosityJump<dim>>
  find_jump(const Simplex<dim>                              &x,
            const VertexValues<dim>                         &at_vertices,
            const std::function<double(const Point<dim> &)> &viscosity)
  {
    const Sides<dim> sides(at_vertices);
    if (!sides.exist())
      return {};
    Tensor<1, dim>          up;
    std::vector<Point<dim>> crossings;
    for (unsigned int i = 0; i <= dim; ++i)
      for (unsigned int j = 0; j <= dim; ++j)
        if (!sides.is_upper(at_vertices[i]) && sides.is_upper(at_vertices[j]))
          {
            const auto crossing = sides.crossing(x[i], x[j], viscosity);
            if (!crossing)
              return {};
            crossings.push_back(*crossing);
            up += x[j] - x[i];
          }
    const Tensor<1, dim> n = normal_of(crossings);
    if (n.norm() < 1e-6 * std::pow(up.norm(), dim - 1)) // it only touches the cell
      return {};
    return ViscosityJump<dim>{distances<dim>(x, n * up < 0 ? -n : n, crossings), sides.viscosity()};
  }

  template <int dim>
  CarriedJumps<dim>::CarriedJumps(const Mesh<dim> &mesh, const CarriedField &field, const std::vector<double> &liquid_volume)
    : mesh(mesh)
    , field(field)
    , slope(mesh.nodes)
  {
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        Tensor<1, dim> mean;
        mean_of_cells(
          mesh,
          node,
          [&](const LocalIndex c) { return liquid_volume[c] > 0; },
          [&](const LocalIndex c) { return cell_gradient(mesh, c, field.mean); },
          mean);
        slope.set(node, mean);
      }
    slope.update_ghost_values();
  }

  template <int dim>
  std::optional<ViscosityJump<dim>>
  CarriedJumps<dim>::operator()(const LocalIndex cell, const TwoValues &two) const
  {
    const double            middle = 0.5 * (two.least() + two.largest());
    const VertexValues<dim> values = mesh.values(cell, field.mean);
    const Simplex<dim>      x      = mesh.cell_vertices(cell);
    Tensor<1, dim>          n;
    std::vector<Point<dim>> crossings;
    for (unsigned int i = 0; i <= dim; ++i)
      {
        n += slope.value(mesh.cell_nodes[cell][i]);
        for (unsigned int j = 0; j <= dim; ++j)
          if (values[i] <= middle && values[j] > middle)
            crossings.push_back(x[i] + (middle - values[i]) / (values[j] - values[i]) * (x[j] - x[i]));
      }
    if (crossings.empty() || n.norm() == 0)
      return {};
    return ViscosityJump<dim>{distances<dim>(x, n, crossings), {{two.least(), two.largest()}}};
  }

  template std::optional<ViscosityJump<2>>
  find_jump(const Simplex<2> &, const VertexValues<2> &, const std::function<double(const Point<2> &)> &);
  template std::optional<ViscosityJump<3>>
  find_jump(const Simplex<3> &, const VertexValues<3> &, const std::function<double(const Point<3> &)> &);
  template class CarriedJumps<2>;
  template class CarriedJumps<3>;
} // namespace treacle
