// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/initial_state.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    using Distance = std::function<double(const Point<dim> &)>;

    template <int dim>
    void
    check_finite(const Mesh<dim> &mesh, const std::string &name, const Distance<dim> &distance)
    {
      const auto &x      = mesh.node_position;
      const bool  finite = std::all_of(x.begin(), x.end(), [&](const Point<dim> &p) {
        return std::isfinite(distance(p));
      });
      require(Utilities::MPI::min(finite ? 1 : 0, mesh.communicator()) == 1,
              name + ": the Expression is not finite somewhere in the box: mend it.");
    }

    /// Is some of a body in the box, and some of that outside solids?
    template <int dim>
    void
    check_body(const Mesh<dim>     &mesh,
               const Scene<dim>    &scene,
               const std::string   &name,
               const Distance<dim> &distance,
               const double         time)
    {
      check_finite(mesh, name, distance);
      const MPI_Comm &comm   = mesh.communicator();
      bool            in_box = false, outside_solids = false;
      std::string     error;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (const Point<dim> &x = mesh.node_position[node]; distance(x) < 0)
          {
            in_box = true;
            keep_error(error, [&] {
              outside_solids = outside_solids || scene.solid_distance(x, time) > 0;
            });
          }
      throw_first(comm, error);
      require(Utilities::MPI::max(in_box ? 1 : 0, comm) == 1,
              name + (mesh.is_lattice() ?
                        " lies outside the box, or is smaller than the cells: move it, "
                        "change Domain/Lower corner and Upper corner, or raise "
                        "Mesh/Surface level." :
                        " lies outside the mesh, or is smaller than its cells: move it, "
                        "or change Mesh/File."));
      require(Utilities::MPI::max(outside_solids ? 1 : 0, comm) == 1,
              name + " lies inside a solid: move one of them.");
    }
  } // namespace

  template <int dim>
  void
  check_bodies(const Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    if (scene.has_solids())
      check_finite<dim>(mesh, "Solids", [&](const Point<dim> &x) {
        return scene.solid_distance(x, 0);
      });
    for (unsigned int k = 0; k < scene.n_liquids(); ++k)
      check_body<dim>(
        mesh,
        scene,
        "Liquid " + std::to_string(k + 1),
        [&](const Point<dim> &x) { return scene.liquid_distance(k, x); },
        0);
    for (const Emitter<dim> &emitter : scene.emitters())
      check_body<dim>(
        mesh,
        scene,
        emitter.where,
        [&](const Point<dim> &x) { return emitter.signed_distance(x); },
        emitter.start_time);
  }

  template <int dim>
  void
  check_walls(const Mesh<dim> &mesh, const Scene<dim> &scene, const std::string &file)
  {
    const auto is_oblique = [](const unsigned char wall) { return wall == Walls<dim>::oblique; };
    std::string error;
    if (!scene.no_slip(Walls<dim>::oblique) &&
        std::any_of(mesh.face_side.begin(),
                    mesh.face_side.begin() + mesh.n_owned_faces(),
                    is_oblique))
      error = "Domain/Wall condition: liquid slips along walls normal to an axis only, and "
              "the mesh \"" + file +
              "\" has others; let the default be no slip, as in \"default: no slip; top: "
              "free slip\".";
    throw_first(mesh.communicator(), error);
  }

  namespace
  {
    /// In leaves: what is given as close to a solid as this touches it, and goes on into it as far as that.
    constexpr double touching = 0.1, into_solids = 3;

    /// Of the distance from the scene's solids at t = 0, by differences over +-d (m); a formula's need not have length 1.
    template <int dim>
    Tensor<1, dim>
    solid_gradient(const Scene<dim> &scene, const Point<dim> &x, const double d)
    {
      Tensor<1, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        {
          const Tensor<1, dim> along = d * Point<dim>::unit_vector(a);
          result[a] = (scene.solid_distance(x + along, 0) - scene.solid_distance(x - along, 0)) / (2 * d);
        }
      return result;
    }

    /// The distance to the liquid at t = 0, but in solids that of its image behind the wall where it touches that: nodes would
    /// see a film of air between two bodies that end at the same place. Near the contact line the free surface goes on
    /// straight. h (m) is the edge of the leaves.
    template <int dim>
    double
    initial_distance(const Scene<dim> &scene, const Point<dim> &x, const double h)
    {
      const double phi = scene.liquid_distance(x);
      if (phi <= 0 || !scene.has_solids())
        return phi;
      const double s = scene.solid_distance(x, 0);
      if (s >= 0)
        return phi;
      const Tensor<1, dim> gradient = solid_gradient(scene, x, 0.01 * h);
      const double         slope    = gradient.norm();
      if (!(slope > 0) || -s > into_solids * h * slope)
        return phi;
      const double         depth = -s / slope;
      const Tensor<1, dim> out   = gradient / slope;
      const auto           before = [&](const double way) { return scene.liquid_distance(x + (depth + way) * out); };
      if (before(touching * h) >= 0)
        return phi;
      const double near = before(0.5 * depth), far = before(depth);
      const bool   is_free = near > -0.45 * depth && far > -0.9 * depth; // else it is the wall that is near
      return std::min(phi, is_free ? near + 3 * (near - far) : far);
    }
  } // namespace

  template <int dim>
  void
  set_initial_level_set(State<dim> &state, const Scene<dim> &scene)
  {
    const Mesh<dim> &mesh = *state.mesh;
    std::string      error;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      keep_error(error, [&] {
        state.phi.local_element(node) =
          initial_distance(scene, mesh.node_position[node], mesh.finest_size());
      });
    throw_first(mesh.communicator(), error);
    state.phi.update_ghost_values();
  }

  template <int dim>
  void
  set_initial_velocity(State<dim> &state, const LiquidDomain<dim> &domain)
  {
    const Mesh<dim> &mesh = domain.mesh;
    std::string      error;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        keep_error(error, [&] {
          state.u.local_element(f) =
            domain.scene.initial_velocity(mesh.face_centre[f]) * mesh.face_normal[f];
        });
    throw_first(mesh.communicator(), error);
    state.u.update_ghost_values();
  }

#define INSTANTIATE(dim)                                                                    \
  template void check_bodies(const Mesh<dim> &, const Scene<dim> &);                        \
  template void check_walls(const Mesh<dim> &, const Scene<dim> &, const std::string &);    \
  template void set_initial_level_set(State<dim> &, const Scene<dim> &);                    \
  template void set_initial_velocity(State<dim> &, const LiquidDomain<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
