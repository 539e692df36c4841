// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_liquid_h
#define treacle_surface_liquid_h

#include <treacle/fields/full_container.h>
#include <treacle/surface/surface_geometry.h>

namespace treacle
{
  /// The state, and what follows from it, each made once: for a mesh, for a surface, for
  /// where the liquid is.
  template <int dim>
  struct Liquid
  {
    /// All of it, of a state.
    static Liquid
    of(std::shared_ptr<State<dim>>                    state,
       const Scene<dim>                              &scene,
       const typename LiquidDomain<dim>::Parameters &parameters)
    {
      Liquid result{std::make_shared<const MeshData<dim>>(*state->mesh, scene),
                    state,
                    std::make_shared<const SurfaceGeometry<dim>>(state->mesh, state->phi),
                    nullptr};
      result.find(parameters);
      return result;
    }

    std::shared_ptr<const MeshData<dim>>        mesh_data;
    std::shared_ptr<State<dim>>                 state;
    std::shared_ptr<const SurfaceGeometry<dim>> surface;
    std::shared_ptr<const LiquidDomain<dim>>    domain; ///< null while the liquid moves

    /// Measure where the liquid is now.
    void
    find(const typename LiquidDomain<dim>::Parameters &parameters)
    {
      domain = liquid_domain_of(parameters, *state, *mesh_data);
    }
  };
} // namespace treacle

#endif
