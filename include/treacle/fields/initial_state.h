// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_initial_state_h
#define treacle_fields_initial_state_h

#include <treacle/fields/liquid_domain.h>
#include <treacle/geometry/distance.h>

#include <unordered_map>

namespace treacle
{
  /// Throws a UserError on all ranks where a liquid or emitter is outside of the mesh or in
  /// a solid, or an expression is not finite. Collective.
  template <int dim>
  void
  check_bodies(const Mesh<dim> &mesh, const Scene<dim> &scene);

  /// Throws a UserError on all ranks where liquid slips along oblique walls. @p file is the
  /// mesh's. Collective.
  template <int dim>
  void
  check_walls(const Mesh<dim> &mesh, const Scene<dim> &scene, const std::string &file);

  /// The distance to the liquids and emitters of a @p scene, which must outlive it, at t = 0. Liquids go on beyond walls that they touch, those of the
  /// box (if it @p has_box, not an imported mesh) and of solids. @p h (m) is the edge of the leaves. Throws where a solid's is not known.
  template <int dim>
  Distance<dim>
  initial_distance(const Scene<dim> &scene, const bool has_box, const double h);

  /// That distance at the nodes; ghosts are up to date. Asked for only where it is not @p known, by the keys of nodes, from other meshes of
  /// the same box and finest leaf; then it is. Throws a UserError on all ranks where it cannot be known. Collective.
  template <int dim>
  void
  set_initial_level_set(State<dim> &state, const Scene<dim> &scene, std::unordered_map<VertexKey, double> &known);

  /// The same, with none known.
  template <int dim>
  void
  set_initial_level_set(State<dim> &state, const Scene<dim> &scene)
  {
    std::unordered_map<VertexKey, double> none;
    set_initial_level_set(state, scene, none);
  }

  /// The velocity of the scene's liquids at t = 0 on liquid faces. Throws a UserError on all
  /// ranks where it is not finite. Collective.
  template <int dim>
  void
  set_initial_velocity(State<dim> &state, const LiquidDomain<dim> &domain);
} // namespace treacle

#endif
