// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/io/probes.h>
#include <treacle/mesh/locator.h>

#include <algorithm>
#include <numeric>

namespace treacle
{
  namespace
  {
    std::string
    name(const unsigned int k)
    {
      return "Probe " + std::to_string(k + 1);
    }

    /// Pressure at x, as a linear fit to the pressure cells around an owned node has it, or
    /// their mean.
    template <int dim>
    double
    fitted_pressure(const State<dim>        &state,
                    const LiquidDomain<dim> &domain,
                    const LocalIndex         node,
                    const Point<dim>        &x)
    {
      const Mesh<dim>      &mesh = domain.mesh;
      std::vector<LocalIndex> around;
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        if (const LocalIndex c = mesh.node_cells[k];
            domain.is_pressure_cell[c] && domain.liquid_volume[c] > 0)
          around.push_back(c);
      if (around.empty())
        return 0;
      Tensor<1, dim> centre;
      double         mean = 0;
      for (const LocalIndex c : around)
        {
          centre += mesh.cell_dual[c] / (1. * around.size());
          mean += state.pressure.local_element(c) / around.size();
        }
      Tensor<2, dim> matrix;
      Tensor<1, dim> rhs;
      for (const LocalIndex c : around)
        {
          const Tensor<1, dim> r = mesh.cell_dual[c] - centre;
          matrix += outer_product(r, r);
          rhs += r * (state.pressure.local_element(c) - mean);
        }
      if (determinant(matrix) < 1e-6 * std::pow(trace(matrix) / dim, dim))
        return mean;
      return mean + (invert(matrix) * rhs) * (x - centre);
    }
  } // namespace

  template <int dim>
  void
  Probes<dim>::Parameters::add_parameters(ParameterHandler &prm, const unsigned int n)
  {
    positions.assign(n, diagonal_point<dim>(0.5));
    for (unsigned int k = 0; k < n; ++k)
      {
        prm.enter_subsection(name(k));
        prm.add_parameter("Position",
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
              name(k) + "/Position lies outside the box: move it, or change Domain/Lower corner "
                        "and Upper corner.");
  }

  template <int dim>
  void
  Probes<dim>::check(const Mesh<dim> &mesh) const
  {
    const std::vector<Point<dim>> inside = Locator<dim>(mesh).clamped(positions);
    for (unsigned int k = 0; k < positions.size(); ++k)
      require(positions[k].distance(inside[k]) < 1e-9 * mesh.finest_size(),
              name(k) + "/Position lies outside the mesh: move it, or change Mesh/File.");
  }

  template <int dim>
  std::vector<typename Probes<dim>::Values>
  Probes<dim>::read(const State<dim> &state, const LiquidDomain<dim> &domain) const
  {
    if (positions.empty())
      return {};
    const Mesh<dim>    &mesh = domain.mesh;
    const Locator<dim>  locator(mesh);
    const auto          owners = locator.owners(positions);
    const unsigned int  rank   = Utilities::MPI::this_mpi_process(mesh.communicator());
    std::vector<double> numbers(positions.size() * (dim + 1), 0.);
    const auto          size  = std::max_element(mesh.cell_size.begin(), mesh.cell_size.end());
    const double        reach = 3 * Utilities::MPI::max(size == mesh.cell_size.end() ? 0. : *size,
                                                 mesh.communicator());
    state.pressure.update_ghost_values();
    for (unsigned int k = 0; k < positions.size(); ++k)
      {
        // at the nodes, by their owners: the cell that holds the point may be a ghost
        Vector pressure = mesh.zeros(mesh.nodes);
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          if (mesh.node_position[node].distance(positions[k]) < reach)
            pressure.local_element(node) = fitted_pressure(state, domain, node, positions[k]);
        pressure.update_ghost_values();
        if (owners[k].rank != rank)
          continue;
        const Location<dim>     location = locator.locate_here(owners[k].point);
        AssertThrow(location.cell != invalid, ExcMessage("No cell contains " + name(k) + "."));
        const auto             &nodes    = mesh.cell_nodes[location.cell];
        const VertexValues<dim> phi      = mesh.values(location.cell, state.phi);
        if (std::inner_product(phi.begin(), phi.end(), location.lambda.begin(), 0.) > 0)
          continue;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            const Tensor<1, dim> v = state.v.value(nodes[i]);
            for (unsigned int d = 0; d < dim; ++d)
              numbers[k * (dim + 1) + d] += location.lambda[i] * v[d];
            // continuous, for a point between cells may be found in any of them
            numbers[k * (dim + 1) + dim] += location.lambda[i] * pressure.local_element(nodes[i]);
          }
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
