// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_tests_steps_body_h
#define treacle_tests_steps_body_h

#include "run_scene.h"

#include <treacle/steps/redistance.h>
#include <treacle/steps/remesh.h>

namespace tests
{
  /// A body of liquid as a parameter text describes it, for single steps.
  template <int dim>
  struct Body
  {
    Body(const MPI_Comm &comm, const std::string &text, const unsigned int n_solids = 0)
      : prm(parse<dim>(text, n_solids))
      , scene(prm.scene)
      , state(make_state(comm))
      , domain(state, scene, prm.projection.minimum_theta)
      , fit(prm.face_fit, domain)
    {}

    /// Set the face velocity to that of a field.
    void
    set_velocity(const std::function<Tensor<1, dim>(const Point<dim> &)> &velocity)
    {
      const Mesh<dim> &mesh = *state.mesh;
      state.u.zero_out_ghost_values();
      for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
        state.u.local_element(f) = velocity(mesh.face_centre[f]) * mesh.face_normal[f];
      state.u.update_ghost_values();
    }

    typename Simulator<dim>::Parameters prm;
    Scene<dim>                          scene;
    State<dim>                          state;
    LiquidDomain<dim>                   domain;
    FaceFit<dim>                        fit;

  private:
    State<dim>
    make_state(const MPI_Comm &comm)
    {
      prm.mesh.lower_corner = scene.lower_corner();
      prm.mesh.upper_corner = scene.upper_corner();
      State<dim>       result(initial_mesh<dim>(comm, prm.mesh, scene));
      const Mesh<dim> &mesh = *result.mesh;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        result.phi.local_element(node) = scene.liquid_distance(mesh.node_position[node]);
      result.phi.update_ghost_values();
      redistance(result, 6 * mesh.finest_size());
      return result;
    }
  };

  /// The subsection of a mesh that is two levels coarser away from the surface.
  inline std::string
  graded_mesh(const unsigned int level)
  {
    return "subsection Mesh\nset Surface level = " + std::to_string(level) +
           "\nset Interior level = " + std::to_string(level - 2) +
           "\nset Air level = 1\nset Band width = 2\nend\n";
  }
} // namespace tests

#endif
