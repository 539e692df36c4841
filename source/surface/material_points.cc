// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/moved_points.h>
#include <treacle/mesh/surface_size.h>
#include <treacle/surface/material_points.h>
#include <treacle/surface/point_means.h>
#include <treacle/surface/sowing.h>

namespace treacle
{
  namespace
  {
    /// Material points in a cell about a jump.
    template <int dim>
    constexpr unsigned int points_per_cell = dim == 2 ? 6 : 4;
    /// Rings of cells about a jump that have points.
    constexpr unsigned int n_rings = 2;
  } // namespace

  template <int dim>
  MaterialPoints<dim>::MaterialPoints(State<dim> &state, const MeshData<dim> &data)
    : state(state)
    , data(data)
    , mesh(data.mesh)
    , material(*state.material)
    , solid_distance(data.solid_distance(state.time))
    , density{material.density, &MaterialPoint<dim>::density, &MaterialPoint<dim>::mean_density}
    , viscosity{material.viscosity, &MaterialPoint<dim>::viscosity, &MaterialPoint<dim>::mean_viscosity}
    , known(mesh.nodes)
    , count(mesh.cells)
  {
    locate();
    const PointMeans<dim> means(data, material.points, place);
    // liquid may have come where nothing brought its material
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      known.local_element(node) =
        means.weight(node) > 0 ||
        (state.phi.local_element(node) < 0 && material.density.mean.local_element(node) > 0);
    known.update_ghost_values();
    for (MaterialProperty<dim> *property : {&density, &viscosity})
      {
        property->spread = spread_of(*property);
        means.give(*property, known);
      }
  }

  template <int dim>
  void
  MaterialPoints<dim>::locate()
  {
    std::vector<MaterialPoint<dim>> kept;
    for (const MaterialPoint<dim> &point : material.points)
      {
        Location<dim> found = mesh.locator().locate_here(point.position);
        if (found.cell == invalid)
          continue;
        const double reach = 0.5 * surface_size_of_cell(mesh, found.cell);
        if (interpolate(mesh.values(found.cell, state.phi), found.lambda) > reach ||
            interpolate(mesh.values(found.cell, solid_distance), found.lambda) < -reach)
          continue;
        for (double &lambda : found.lambda)
          if (lambda <= 1e-9)
            lambda = 0; // no sum of roundoff
        kept.push_back(point);
        place.push_back(found);
        count.local_element(found.cell) += 1;
      }
    material.points = std::move(kept);
    count.compress(VectorOperation::add);
    count.update_ghost_values();
  }

  template <int dim>
  double
  MaterialPoints<dim>::spread_of(const MaterialProperty<dim> &property) const
  {
    double     least = std::numeric_limits<double>::max(), largest = -least;
    const auto take = [&](const double value) {
      least   = std::min(least, value);
      largest = std::max(largest, value);
    };
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (state.phi.local_element(node) < 0 && is_known(node))
        take(property.field.mean.local_element(node));
    for (const MaterialPoint<dim> &point : material.points)
      take(point.*property.of_point);
    const MPI_Comm comm = mesh.communicator();
    return Utilities::MPI::max(largest, comm) - Utilities::MPI::min(least, comm);
  }

  template <int dim>
  Vector
  MaterialPoints<dim>::cells_about_jumps() const
  {
    Vector is_wanted(mesh.cells), is_near(mesh.nodes);
    is_near.update_ghost_values();
    for (unsigned int ring = 0; ring <= n_rings; ++ring)
      {
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          if (is_wanted.local_element(c) == 0)
            is_wanted.local_element(c) =
              ring == 0 ? has_jump(c) :
                          std::any_of(mesh.cell_nodes[c].begin(),
                                      mesh.cell_nodes[c].end(),
                                      [&](const auto node) { return is_near.local_element(node) > 0; });
        is_near.zero_out_ghost_values();
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          if (is_wanted.local_element(c) > 0)
            for (const LocalIndex node : mesh.cell_nodes[c])
              is_near.local_element(node) = 1;
        is_near.compress(VectorOperation::max);
        is_near.update_ghost_values();
      }
    is_wanted.update_ghost_values();
    return is_wanted;
  }

  template <int dim>
  bool
  MaterialPoints<dim>::has_jump(const LocalIndex c) const
  {
    for (const MaterialProperty<dim> *property : {&density, &viscosity})
      {
        double least = std::numeric_limits<double>::max(), largest = -least;
        for (const LocalIndex node : mesh.cell_nodes[c])
          if (is_known(node))
            {
              least   = std::min(least, property->field.least.local_element(node));
              largest = std::max(largest, property->field.largest.local_element(node));
            }
        if (largest >= least && property->jumps(least, largest))
          return true;
      }
    return false;
  }

  template <int dim>
  void
  MaterialPoints<dim>::thin(const Vector &is_wanted)
  {
    std::vector<MaterialPoint<dim>> kept;
    for (unsigned int k = 0; k < place.size(); ++k)
      {
        const LocalIndex c = place[k].cell;
        if (is_wanted.local_element(c) > 0 &&
            stays(mesh, material.points[k].position, count.local_element(c), points_per_cell<dim>))
          kept.push_back(material.points[k]);
      }
    material.points = std::move(kept);
  }

  template <int dim>
  std::vector<VertexValues<dim>>
  MaterialPoints<dim>::places_in(const LocalIndex c) const
  {
    const double                   start = start_of_seeds(mesh, c);
    const VertexValues<dim>        phi = mesh.values(c, state.phi), solid = mesh.values(c, solid_distance);
    std::vector<VertexValues<dim>> places;
    for (unsigned int k = 0; k < points_per_cell<dim>; ++k)
      {
        const VertexValues<dim> lambda = even_point_in_simplex<dim>(start, k);
        if (interpolate(phi, lambda) < 0 && interpolate(solid, lambda) > 0)
          places.push_back(lambda);
      }
    return places;
  }

  template <int dim>
  void
  MaterialPoints<dim>::reseed(const Make &make)
  {
    const Vector is_wanted = cells_about_jumps();
    thin(is_wanted);
    std::vector<MaterialPoint<dim>> seeds;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        if (is_wanted.local_element(c) == 0)
          continue;
        const auto         places = places_in(c);
        const unsigned int n      = count.local_element(c);
        for (unsigned int k = n; 2 * n < places.size() && k < places.size(); ++k)
          {
            Point<dim> x;
            for (unsigned int i = 0; i <= dim; ++i)
              x += places[k][i] * mesh.node_position[mesh.cell_nodes[c][i]];
            seeds.push_back(make(x, c, places[k]));
          }
      }
    seeds = to_owners(mesh, seeds); // a cell may be another rank's than its leaf
    material.points.insert(material.points.end(), seeds.begin(), seeds.end());
  }

  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace treacle
