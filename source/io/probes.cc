// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/io/probes.h>
#include <treacle/mesh/locator.h>
#include <treacle/scene/bodies.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    /// A linear fit at x to the values around it, or their mean.
    template <int dim>
    double
    fit_at(const Point<dim>              &x,
           const std::vector<Point<dim>> &positions,
           const std::vector<double>     &values)
    {
      const unsigned int n = values.size();
      Tensor<1, dim>     centre;
      double             mean = 0;
      for (unsigned int i = 0; i < n; ++i)
        {
          centre += positions[i] / (1. * n);
          mean += values[i] / n;
        }
      Tensor<2, dim> matrix;
      Tensor<1, dim> rhs;
      for (unsigned int i = 0; i < n; ++i)
        {
          const Tensor<1, dim> r = positions[i] - centre;
          matrix += outer_product(r, r);
          rhs += r * (values[i] - mean);
        }
      if (determinant(matrix) < 1e-6 * std::pow(trace(matrix) / dim, dim))
        return mean;
      return mean + (invert(matrix) * rhs) * (x - centre);
    }

    /// Pressure at x, as a fit to the pressure cells around an owned node has it.
    template <int dim>
    double
    fitted_pressure(const State<dim>        &state,
                    const LiquidDomain<dim> &domain,
                    const LocalIndex         node,
                    const Point<dim>        &x)
    {
      const Mesh<dim>        &mesh = domain.mesh;
      std::vector<Point<dim>> centres;
      std::vector<double>     values;
      for (unsigned int k = mesh.node_cell_start[node];
           k < mesh.node_cell_start[node + 1];
           ++k)
        if (const LocalIndex c = mesh.node_cells[k]; domain.is_pressure_cell[c])
          {
            centres.push_back(mesh.cell_dual[c]);
            values.push_back(state.pressure.local_element(c));
          }
      return values.empty() ? 0 : fit_at(x, centres, values);
    }

    /// The edge of the largest leaf on any rank (m).
    template <int dim>
    double
    largest_cell_size(const Mesh<dim> &mesh)
    {
      const auto size = std::max_element(mesh.cell_size.begin(), mesh.cell_size.end());
      return Utilities::MPI::max(size == mesh.cell_size.end() ? 0. : *size,
                                 mesh.communicator());
    }

    /// The pressure at x as each node near it has it, by the owners of the nodes, for the
    /// cell that holds x may be a ghost. Collective.
    template <int dim>
    Vector
    pressure_around(const State<dim>        &state,
                    const LiquidDomain<dim> &domain,
                    const Point<dim>        &x,
                    const double             reach)
    {
      const Mesh<dim> &mesh     = domain.mesh;
      Vector           pressure = mesh.zeros(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (mesh.node_position[node].distance(x) < reach)
          pressure.local_element(node) = fitted_pressure(state, domain, node, x);
      pressure.update_ghost_values();
      return pressure;
    }

    /// Velocity and pressure at a place, in this order; zero outside the liquid.
    template <int dim>
    std::array<double, dim + 1>
    interpolate(const State<dim>    &state,
                const Location<dim> &location,
                const Vector        &pressure)
    {
      const Mesh<dim>            &mesh  = *state.mesh;
      const auto                 &nodes = mesh.cell_nodes[location.cell];
      const VertexValues<dim>     phi   = mesh.values(location.cell, state.phi);
      std::array<double, dim + 1> result{};
      if (treacle::interpolate(phi, location.lambda) > 0)
        return result;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const Tensor<1, dim> v = state.v.value(nodes[i]);
          for (unsigned int d = 0; d < dim; ++d)
            result[d] += location.lambda[i] * v[d];
          // continuous, for a point between cells may be found in any of them
          result[dim] += location.lambda[i] * pressure.local_element(nodes[i]);
        }
      return result;
    }
  } // namespace

  template <int dim>
  void
  Probes<dim>::Parameters::add_parameters(ParameterHandler &prm, const unsigned int n)
  {
    positions.assign(n, diagonal_point<dim>(0.5));
    for (unsigned int k = 0; k < n; ++k)
      {
        prm.enter_subsection(numbered("Probe", k));
        prm.add_parameter(
          "Position",
          positions[k],
          "Where velocity and pressure are read (m); they are columns of the "
          "statistics, zero outside the liquid.");
        prm.leave_subsection();
      }
  }

  template <int dim>
  void
  Probes<dim>::check(const Scene<dim> &scene) const
  {
    const BoundingBox<dim> box({scene.lower_corner(), scene.upper_corner()});
    for (unsigned int k = 0; k < positions.size(); ++k)
      require(box.point_inside(positions[k]),
              numbered("Probe", k) +
                "/Position lies outside the box: move it, or change Domain/Lower corner "
                "and Upper corner.");
  }

  template <int dim>
  void
  Probes<dim>::check(const Mesh<dim> &mesh) const
  {
    const std::vector<Point<dim>> inside = mesh.locator().clamped(positions);
    for (unsigned int k = 0; k < positions.size(); ++k)
      require(positions[k].distance(inside[k]) < 1e-9 * mesh.finest_size(),
              numbered("Probe", k) +
                "/Position lies outside the mesh: move it, or change Mesh/File.");
  }

  template <int dim>
  std::vector<typename Probes<dim>::Values>
  Probes<dim>::read(const State<dim> &state, const LiquidDomain<dim> &domain) const
  {
    if (positions.empty())
      return {};
    const Mesh<dim>    &mesh = domain.mesh;
    const Locator<dim> &locator = mesh.locator();
    const auto          owners = locator.owners(positions);
    const unsigned int  rank   = Utilities::MPI::this_mpi_process(mesh.communicator());
    const double        reach  = 3 * largest_cell_size(mesh);
    std::vector<double> numbers(positions.size() * (dim + 1), 0.);
    state.pressure.update_ghost_values();
    for (unsigned int k = 0; k < positions.size(); ++k)
      {
        const Vector pressure = pressure_around(state, domain, positions[k], reach);
        if (owners[k].rank != rank)
          continue;
        const Location<dim> location = locator.locate_here(owners[k].point);
        AssertThrow(location.cell != invalid, ExcMessage("No cell contains " + numbered("Probe", k) + "."));
        const auto values = interpolate(state, location, pressure);
        std::copy(values.begin(), values.end(), numbers.begin() + k * (dim + 1));
      }
    Utilities::MPI::sum(numbers, mesh.communicator(), numbers);
    std::vector<Values> result(positions.size());
    for (unsigned int k = 0; k < positions.size(); ++k)
      {
        for (unsigned int d = 0; d < dim; ++d)
          result[k].velocity[d] = numbers[k * (dim + 1) + d];
        result[k].pressure = numbers[k * (dim + 1) + dim];
      }
    return result;
  }

  template class Probes<2>;
  template class Probes<3>;
} // namespace treacle
