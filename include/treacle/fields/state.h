// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_state_h
#define treacle_fields_state_h

#include <treacle/fields/marker.h>
#include <treacle/fields/material_point.h>
#include <treacle/mesh/mesh.h>

#include <memory>
#include <optional>

namespace treacle
{
  /// A property of the liquid that it carries along.
  struct CarriedField
  {
    Vector mean;           ///< at nodes
    Vector least, largest; ///< of the material points about a node at a jump; elsewhere the mean

    explicit CarriedField(const std::shared_ptr<const Utilities::MPI::Partitioner> &nodes)
      : mean(nodes)
      , least(nodes)
      , largest(nodes)
    {}

    /// The same for all that is about an owned node.
    void
    set(const LocalIndex node, const double value)
    {
      for (Vector *v : {&mean, &least, &largest})
        v->local_element(node) = value;
    }

    void
    update_ghost_values() const
    {
      for (const Vector *v : {&mean, &least, &largest})
        v->update_ghost_values();
    }
  };

  /// Material that the liquid carries along: at nodes, and where it jumps by points.
  template <int dim>
  struct CarriedMaterial
  {
    CarriedField density;   ///< kg/m^dim
    CarriedField viscosity; ///< Pa s
    /// Each on the rank that owns the cell it lies in (of a lattice: the leaf).
    std::vector<MaterialPoint<dim>> points;

    explicit CarriedMaterial(const std::shared_ptr<const Utilities::MPI::Partitioner> &nodes)
      : density(nodes)
      , viscosity(nodes)
    {}

    void
    update_ghost_values() const
    {
      density.update_ghost_values();
      viscosity.update_ghost_values();
    }
  };



  /// The velocity of the step before, on the mesh of now (m/s).
  template <int dim>
  struct VelocityBefore
  {
    double                         dt; ///< since then (s)
    std::optional<NodeVector<dim>> v;  ///< where liquid is advected
    /// And what the liquid that is at a node now had where it was then; NaN where that is not known.
    std::optional<NodeVector<dim>> v_along;
    /// Of the faces: where liquid is advected what v misses of it, u - P v; NaN where the mesh before had no such face.
    std::optional<Vector>          u;

    /// Is v_along known there?
    bool
    remembers(const LocalIndex node) const
    {
      return !std::isnan(v_along->component[0].local_element(node));
    }
  };



  /// All that evolves. Every step leaves the ghosts of what it changed up to date.
  template <int dim>
  struct State
  {
    /// At rest and without liquid.
    explicit State(std::shared_ptr<const Mesh<dim>> mesh)
      : mesh(std::move(mesh))
      , phi(this->mesh->nodes)
      , u(this->mesh->faces)
      , v(this->mesh->nodes)
      , pressure(this->mesh->cells)
    {}

    std::shared_ptr<const Mesh<dim>> mesh;

    double       time = 0; ///< s
    unsigned int step = 0;

    Vector            phi;      ///< level set at nodes (m)
    Vector            u;        ///< face velocity, along the face's normal (m/s)
    NodeVector<dim>   v;        ///< node velocity, for tracing and output (m/s)
    Vector            pressure; ///< at dual centres, of the last projection (Pa)

    std::optional<CarriedMaterial<dim>> material; ///< if it is advected
    std::optional<VelocityBefore<dim>> before;   ///< if the time scheme needs it
    /// Each on the rank that owns the cell it lies in (of a lattice: the leaf); none without marker level set.
    std::vector<Marker<dim>> markers;
  };

  /// With ghosts, which copies of vectors go without. Collective.
  template <int dim>
  std::unique_ptr<State<dim>>
  copied(const State<dim> &state)
  {
    auto copy = std::make_unique<State<dim>>(state);
    for (const Vector *vector : {&copy->phi, &copy->u, &copy->pressure})
      vector->update_ghost_values();
    copy->v.update_ghost_values();
    if (copy->material)
      copy->material->update_ghost_values();
    if (copy->before && copy->before->v)
      for (const auto *v : {&*copy->before->v, &*copy->before->v_along})
        v->update_ghost_values();
    if (copy->before && copy->before->u)
      copy->before->u->update_ghost_values();
    return copy;
  }
} // namespace treacle

#endif
