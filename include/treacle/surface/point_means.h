// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_point_means_h
#define treacle_surface_point_means_h

#include <treacle/fields/mesh_data.h>
#include <treacle/mesh/locator.h>
#include <treacle/surface/material_property.h>

namespace treacle
{
  /// What the material points about the nodes tell them. Refers to its arguments; members are collective.
  template <int dim>
  class PointMeans
  {
  public:
    /// With the places of the points in the mesh.
    PointMeans(const MeshData<dim>                   &data,
               const std::vector<MaterialPoint<dim>> &points,
               const std::vector<Location<dim>>      &place);

    /// Of the points around a node, by P1.
    double
    weight(const LocalIndex node) const
    {
      return weights.local_element(node);
    }

    /// A node about a jump takes what was brought there, which the field has, and what that misses of its points' means, but does not go far from
    /// the mean of its points. Other nodes keep what they have, within bounds that the points set. @p known is 1 at nodes that know their material.
    void
    give(const MaterialProperty<dim> &property, const Vector &known) const;

  private:
    /// Where the points about a node have two values: these, and their mean.
    void
    find_jumps(const MaterialProperty<dim> &property) const;

    /// About jumps a mean over neighbours as well: where the middle is must not depend on how the points
    /// happen to lie, for cells of either kind strewn among those of the other are hard to solve for.
    void
    smooth(CarriedField &field, const Vector &known) const;

    /// The mean over the points about a node of what @p brought misses of their means there, at owned nodes.
    Vector
    missed(const MaterialProperty<dim> &property, const Vector &brought) const;

    /// Call @p add (node, weight, point) for the nodes of the cell in which a point is.
    template <typename Add>
    void
    for_each(const Add &add) const
    {
      for (unsigned int k = 0; k < place.size(); ++k)
        for (unsigned int i = 0; i <= dim; ++i)
          add(mesh.cell_nodes[place[k].cell][i], place[k].lambda[i], k);
    }

    const MeshData<dim>                   &data;
    const Mesh<dim>                       &mesh;
    const std::vector<MaterialPoint<dim>> &points;
    const std::vector<Location<dim>>      &place;
    Vector                                 weights;
  };
} // namespace treacle

#endif
