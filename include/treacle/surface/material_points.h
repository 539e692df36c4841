// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_material_points_h
#define treacle_surface_material_points_h

#include <treacle/fields/mesh_data.h>
#include <treacle/mesh/locator.h>
#include <treacle/surface/material_property.h>

namespace treacle
{
  /// The material points of a state: they lie about where its material jumps, and tell the nodes there
  /// what it is. Members are collective where nothing else is said.
  template <int dim>
  class MaterialPoints
  {
  public:
    /// Points that left the liquid are dropped; the others tell the nodes (PointMeans).
    MaterialPoints(State<dim> &state, const MeshData<dim> &data);

    /// 1 at nodes that know their material, from the liquid they are in or from points; else 0.
    const Vector &
    nodes_that_know() const
    {
      return known;
    }

    /// Density and viscosity.
    std::array<const MaterialProperty<dim> *, 2>
    properties() const
    {
      return {{&density, &viscosity}};
    }

    /// Gives a new point at a position, in a cell and at barycentric coordinates there.
    using Make =
      std::function<MaterialPoint<dim>(const Point<dim> &, LocalIndex, const VertexValues<dim> &)>;

    /// As many points as are wanted in the cells about jumps, and none elsewhere. Nodes learn of new
    /// ones next time.
    void
    reseed(const Make &make);

    /// What a point in a cell is made of, where all its nodes have a material. Not collective.
    MaterialPoint<dim>
    point(const Point<dim> &x, const LocalIndex cell, const VertexValues<dim> &lambda) const
    {
      return {x,
              CarriedInCell<dim>(mesh, density.field, cell).value(lambda),
              CarriedInCell<dim>(mesh, viscosity.field, cell).value(lambda),
              interpolate(mesh.values(cell, density.field.mean), lambda),
              interpolate(mesh.values(cell, viscosity.field.mean), lambda)};
    }

  private:
    bool
    is_known(const LocalIndex node) const
    {
      return known.local_element(node) > 0;
    }

    void
    locate();

    double
    spread_of(const MaterialProperty<dim> &property) const;

    /// 1 for these, also ghosts.
    Vector
    cells_about_jumps() const;

    bool
    has_jump(const LocalIndex cell) const;

    /// Crowded cells keep a part of their points that depends on their places alone.
    void
    thin(const Vector &is_wanted);

    /// Where points are sown in the liquid of a cell.
    std::vector<VertexValues<dim>>
    places_in(const LocalIndex cell) const;

    State<dim>                &state;
    const MeshData<dim>       &data;
    const Mesh<dim>           &mesh;
    CarriedMaterial<dim>      &material;
    const std::vector<double> &solid_distance;
    MaterialProperty<dim>      density, viscosity;
    std::vector<Location<dim>> place;  ///< of the points
    Vector                     known;
    Vector                     count;  ///< of points in each cell
  };
} // namespace treacle

#endif
