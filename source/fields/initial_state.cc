// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/initial_state.h>
#include <treacle/geometry/beyond_wall.h>
#include <treacle/geometry/nearest_point.h>

namespace treacle
{
  namespace
  {
    /// At all nodes of this rank.
    template <int dim>
    std::vector<double>
    finite_distances(const Mesh<dim> &mesh, const std::string &name, const Distance<dim> &distance)
    {
      std::vector<double> values;
      std::string         error; // of a motion
      for (const Point<dim> &x : mesh.node_position)
        keep_error(error, [&] { values.push_back(distance(x)); });
      throw_first(mesh.communicator(), error);
      const bool finite = std::all_of(values.begin(), values.end(), [](const double value) {
        return std::isfinite(value);
      });
      require(Utilities::MPI::min(finite ? 1 : 0, mesh.communicator()) == 1,
              name + ": the Expression is not finite somewhere in the box: mend it.");
      return values;
    }

    /// Those of all cubes about a cube.
    template <int dim>
    std::vector<Tensor<1, dim>>
    directions()
    {
      std::vector<Tensor<1, dim>> result;
      for (unsigned int k = 0; k < Utilities::pow(3u, dim); ++k)
        {
          Tensor<1, dim> direction;
          for (unsigned int d = 0; d < dim; ++d)
            direction[d] = static_cast<int>(k / Utilities::pow(3u, d) % 3) - 1;
          if (direction.norm_square() > 0)
            result.push_back(direction / direction.norm());
        }
      return result;
    }

    /// Does a body hold a ball of radius @p r (m) about a point of the box near @p x? By signs alone, as formulas may be no distances.
    template <int dim>
    bool
    has_room(Point<dim> x, const Distance<dim> &distance, const BoundingBox<dim> &box, const double r)
    {
      const std::vector<Tensor<1, dim>> ways      = directions<dim>();
      const auto                        outermost = [&](const Point<dim> &y) {
        double value = distance(y);
        for (const Tensor<1, dim> &way : ways)
          value = std::max(value, distance(y + r * way));
        return value;
      };
      double value = outermost(x);
      for (double step = r; step > r / 64 && value > 0;)
        {
          const double before = value;
          for (const Tensor<1, dim> &way : ways)
            {
              const Point<dim> next = nearest_point(box, Point<dim>(x + step * way));
              if (const double deeper = outermost(next); deeper < value)
                std::tie(x, value) = std::make_pair(next, deeper);
            }
          if (value == before)
            step /= 2;
        }
      return value <= 0;
    }

    /// What a thinner emitter pours is lost, or counted many times: it is less than phi is off.
    template <int dim>
    void
    check_thickness(const Mesh<dim> &mesh, const Scene<dim> &scene, const Emitter<dim> &emitter)
    {
      constexpr double    thin     = 0.4; // leaves from the middle to the sides
      const Distance<dim> distance = [&](const Point<dim> &x) { return emitter.signed_distance(x); };
      const auto          size     = [&](const LocalIndex node) { // files have cells of any
        double smallest = mesh.cell_size[mesh.node_cells[mesh.node_cell_start[node]]];
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          smallest = std::min(smallest, mesh.cell_size[mesh.node_cells[k]]);
        return smallest;
      };
      bool        has = false;
      std::string error;
      keep_error(error, [&] {
        for (LocalIndex node = 0; node < mesh.n_owned_nodes() && !has; ++node)
          has = distance(mesh.node_position[node]) < 0 &&
                has_room<dim>(mesh.node_position[node], distance, scene.box(), thin * size(node));
      });
      throw_first(mesh.communicator(), error);
      require(Utilities::MPI::max(has ? 1 : 0, mesh.communicator()) == 1,
              emitter.where + " is too thin, what it pours would be lost: let it be a leaf (" +
                digits(mesh.finest_size()) + " m) thick, or reach half a leaf into the box, or " +
                (mesh.is_lattice() ? "raise Mesh/Surface level." : "change Mesh/File."));
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
      const std::vector<double> values = finite_distances(mesh, name, distance);
      const MPI_Comm           &comm   = mesh.communicator();
      bool                      in_box = false, outside_solids = false;
      std::string               error;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        if (values[node] < 0)
          {
            in_box = true;
            keep_error(error, [&] {
              outside_solids = outside_solids || scene.solid_distance(mesh.node_position[node], time) > 0;
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
      finite_distances<dim>(mesh, "Solids", [&](const Point<dim> &x) {
        return scene.solid_distance(x, 0);
      });
    for (unsigned int k = 0; k < scene.n_liquids(); ++k)
      check_body<dim>(
        mesh,
        scene,
        "Liquid " + std::to_string(k + 1),
        [&](const Point<dim> &x) { return scene.side_of_liquid(k, x); },
        0);
    for (const Emitter<dim> &emitter : scene.emitters())
      {
        check_body<dim>(
          mesh,
          scene,
          emitter.where,
          [&](const Point<dim> &x) { return emitter.signed_distance(x); },
          emitter.start_time);
        check_thickness(mesh, scene, emitter);
      }
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

  template <int dim>
  Distance<dim>
  initial_distance(const Scene<dim> &scene, const bool has_box, const double h)
  {
    Distance<dim> liquids = [&scene](const Point<dim> &x) { return scene.distance_to_liquids(x); };
    if (has_box)
      liquids = beyond_sides<dim>(liquids, scene.box(), h);
    const Distance<dim> f = [liquids, &scene](const Point<dim> &x) {
      return std::min(liquids(x), scene.emitter_distance(x, 0));
    };
    const double rounding = scene.rounding();
    if (!scene.has_solids())
      return [f, rounding](const Point<dim> &x) { return snapped(f(x), rounding); };
    const Distance<dim> solids = [&scene, h](const Point<dim> &x) {
      return scene.solid_distance_within(x, AtWall::known * h, 0);
    };
    return [f, solids, h, rounding](const Point<dim> &x) {
      return snapped(beyond_solids<dim>(f, solids, x, h), rounding);
    };
  }

  template <int dim>
  void
  set_initial_level_set(State<dim> &state, const Scene<dim> &scene, std::unordered_map<VertexKey, double> &known)
  {
    const Mesh<dim>    &mesh     = *state.mesh;
    const Distance<dim> distance = initial_distance(scene, mesh.is_lattice(), mesh.finest_size());
    std::string         error;
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      keep_error(error, [&] {
        const auto [entry, is_new] = known.try_emplace(mesh.node_key[node]);
        if (is_new)
          entry->second = distance(mesh.node_position[node]);
        state.phi.local_element(node) = entry->second;
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
            domain.scene.initial_velocity(mesh.face_centre(f)) * mesh.face_normal[f];
        });
    throw_first(mesh.communicator(), error);
    state.u.update_ghost_values();
  }

#define INSTANTIATE(dim)                                                                    \
  template void check_bodies(const Mesh<dim> &, const Scene<dim> &);                        \
  template void check_walls(const Mesh<dim> &, const Scene<dim> &, const std::string &);    \
  template Distance<dim> initial_distance(const Scene<dim> &, const bool, const double);    \
  template void set_initial_level_set(State<dim> &,                                         \
                                      const Scene<dim> &,                                   \
                                      std::unordered_map<VertexKey, double> &);             \
  template void set_initial_velocity(State<dim> &, const LiquidDomain<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
