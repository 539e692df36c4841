// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Air in a pool: a bubble smaller than a leaf that moves with the liquid, and one two leaves across, which liquid fills within two
// steps; a layer on a solid, which fills as fast, a small bubble that opens, one of many leaves at rest, one that fills, and the
// air above. The first two become liquid, without a trace in phi and among the markers; the others stay. Slots thinner than a leaf
// close from below where a step fills most of them.

#include <treacle/fields/liquid_volume.h>
#include <treacle/surface/air_pockets.h>
#include <treacle/surface/surface_tracking.h>

#include "../body.h"

namespace tests::surface_air_pockets
{
namespace
{
  constexpr double solid = 0.15; // its upper side

  /// In the pool, by the centre in the first two coordinates and the radius.
  struct Hole
  {
    double x, y, r;
  };

  /// On leaves of edge h.
  struct Holes
  {
    explicit Holes(const double h)
      : small{{0.25, 0.5, 0.3 * h}, {0.3, 0.65, 0.95 * h}}
      , kept{{0.3, solid - 5.3 * h, 6 * h}, {0.65, 0.3, 0.3 * h}, {0.5, 0.55, 0.1}, {0.78, 0.5, 0.1}}
      , all(small)
    {
      all.insert(all.end(), kept.begin(), kept.end());
    }

    std::vector<Hole> small, kept, all;
  };

  template <int dim>
  Tensor<1, dim>
  from(const Hole &hole, const Point<dim> &x)
  {
    Tensor<1, dim> r = x - diagonal_point<dim>(0.5);
    r[0]             = x[0] - hole.x;
    r[1]             = x[1] - hole.y;
    return r;
  }

  template <int dim>
  double
  distance(const std::vector<Hole> &holes, const Point<dim> &x)
  {
    double phi = x[1] - 0.8;
    for (const Hole &hole : holes)
      phi = std::max(phi, hole.r - from(hole, x).norm());
    return phi;
  }

  template <int dim>
  void
  set_phi(State<dim> &state, const std::vector<Hole> &holes, const double reach)
  {
    state.phi.zero_out_ghost_values();
    for (LocalIndex node = 0; node < state.mesh->n_owned_nodes(); ++node)
      state.phi.local_element(node) =
        std::clamp(distance(holes, state.mesh->node_position[node]), -reach, reach);
    state.phi.update_ghost_values();
  }

  /// Into the holes (1/s): towards the centre by a leaf a second, or as much for their size.
  template <int dim>
  void
  set_velocity(State<dim> &state, const Holes &holes)
  {
    const double h   = state.mesh->finest_size();
    const auto   set = [&](const LocalIndex node, const Hole &hole, const double towards, const double for_size) {
      const Tensor<1, dim> r = from(hole, state.mesh->node_position[node]);
      if (r.norm() < hole.r + 2 * h && r.norm() > 0)
        state.v.set(node, -(towards * h / r.norm() + for_size) * r);
    };
    for (LocalIndex node = 0; node < state.mesh->n_owned_nodes(); ++node)
      {
        set(node, holes.small[1], 1, 0);
        set(node, holes.kept[0], 1, 0);
        set(node, holes.kept[1], -1, 0);
        set(node, holes.kept[3], 0, 2);
        if (from(holes.small[0], state.mesh->node_position[node]).norm() < 3 * h)
          state.v.set(node, 0.3 * Tensor<1, dim>(Point<dim>::unit_vector(0)));
      }
    state.v.update_ghost_values();
  }

  /// The largest difference of phi along an edge over its length: 1 for a distance.
  template <int dim>
  double
  steepest(const State<dim> &state)
  {
    const Mesh<dim> &mesh   = *state.mesh;
    double           result = 0;
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      for (const LocalIndex i : mesh.cell_nodes[c])
        for (const LocalIndex j : mesh.cell_nodes[c])
          if (i != j)
            result = std::max(result,
                              (state.phi.local_element(i) - state.phi.local_element(j)) /
                                mesh.node_position[i].distance(mesh.node_position[j]));
    return Utilities::MPI::max(result, mesh.communicator());
  }

  template <int dim>
  unsigned int
  n_markers(const State<dim> &state, const std::vector<Hole> &holes)
  {
    const unsigned int n =
      std::count_if(state.markers.begin(), state.markers.end(), [&](const Marker<dim> &marker) {
        return std::any_of(holes.begin(), holes.end(), [&](const Hole &hole) {
          return from(hole, marker.position).norm() < hole.r + state.mesh->finest_size();
        });
      });
    return Utilities::MPI::sum(n, state.mesh->communicator());
  }

  template <int dim>
  void
  check(const MPI_Comm &comm)
  {
    const std::string level = dim == 2 ? "6" : "5", rest = dim == 2 ? "" : ", 2";
    const auto        prm =
      parse<dim>("subsection Mesh\nset Surface level = " + level + "\nset Interior level = " + level +
                   "\nset Air level = " + level + "\nend\nsubsection Solid 1\nset Shape = box\nset Lower corner = -1, -1" +
                   (dim == 2 ? "" : ", -1") + "\nset Upper corner = 2, " + std::to_string(solid) + rest + "\nend\n",
                 1);
    const Scene<dim>      scene(prm.scene);
    State<dim>            state(initial_mesh<dim>(comm, prm.mesh, scene));
    const Mesh<dim>      &mesh = *state.mesh;
    const MeshData<dim>   data(mesh, scene);
    const SurfaceTracking<dim> tracking({});
    const double          h = mesh.finest_size(), reach = 6 * h;
    const Holes           holes(h);
    set_velocity(state, holes);
    set_phi(state, holes.kept, reach);
    const treacle::Vector exact  = state.phi;
    const double          volume = liquid_volume(data, state.phi, 0);
    set_phi(state, holes.all, reach);
    tracking.reseed(state, scene, SurfaceGeometry<dim>(state.mesh, state.phi));
    const unsigned int n_kept = n_markers(state, holes.kept), n_slow = n_markers(state, {holes.small[1]});

    close_air_pockets(state, data, 0.01, reach); // a tenth at most fills
    const bool is_kept = n_markers(state, {holes.small[1]}) == n_slow;
    close_air_pockets(state, data, 0.3, reach);
    double error = 0; // facets of what is three leaves large are chords, 0.04 leaves off
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (data.solid_distance(0)[node] > 0 && std::abs(exact.local_element(node)) < 3 * h)
        error = std::max(error, std::abs(state.phi.local_element(node) - exact.local_element(node)) / h);
    error = Utilities::MPI::max(error, comm);
    out() << dim << "D: what fills slowly is " << (is_kept ? "kept" : "NOT KEPT") << "; volume off by "
          << (std::abs(liquid_volume(data, state.phi, 0) / volume - 1) < 1e-9 ? "nothing" : "TOO MUCH") << ", phi by "
          << (error < 0.1 ? "less than 0.1 leaves" : "TOO MUCH") << (steepest(state) < 1.5 ? "" : " and TOO STEEP") << ", markers left "
          << n_markers(state, holes.small) << ", of the others "
          << (n_markers(state, holes.kept) == n_kept ? "all" : "NOT ALL") << std::endl;
  }

  constexpr double bottom = 0.6; // of the slots

  /// How far two slots in the pool are open, 0.6 leaves wide: nodes in the air well below its surface, not at sides of the box.
  template <int dim>
  std::array<unsigned int, 2>
  n_open(const State<dim> &state, const double h)
  {
    std::array<unsigned int, 2> n{{0, 0}};
    for (LocalIndex node = 0; node < state.mesh->n_owned_nodes(); ++node)
      if (const Point<dim> &x = state.mesh->node_position[node];
          state.phi.local_element(node) > 0 && x[1] < 0.8 - 2.5 * h && state.mesh->node_sides[node] == 0)
        ++n[x[0] > 0.5];
    for (unsigned int &i : n)
      i = Utilities::MPI::sum(i, state.mesh->communicator());
    return n;
  }

  /// The sides of one approach each other by two leaves a second, those of the other pass along each other.
  template <int dim>
  void
  check_slots(const MPI_Comm &comm)
  {
    const std::string level = dim == 2 ? "6" : "5";
    const auto        prm   = parse<dim>("subsection Mesh\nset Surface level = " + level + "\nset Interior level = " + level +
                                  "\nset Air level = " + level + "\nend\n",
                                0);
    const Scene<dim>     scene(prm.scene);
    State<dim>           state(initial_mesh<dim>(comm, prm.mesh, scene));
    const Mesh<dim>     &mesh = *state.mesh;
    const MeshData<dim>  data(mesh, scene);
    const double         h = mesh.finest_size(), reach = 6 * h;
    state.phi.zero_out_ghost_values();
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      {
        const Point<dim> &x       = mesh.node_position[node];
        const double      aside   = x[0] - (x[0] < 0.5 ? 0.25 : 0.75) - 0.5 * h; // along the centres of leaves
        const double      in_slot = std::min(0.3 * h - std::abs(aside), x[1] - bottom);
        state.phi.local_element(node) = std::clamp(std::max(x[1] - 0.8, in_slot), -reach, reach);
        if (aside != 0)
          state.v.set(node, (aside < 0 ? h : -h) * Tensor<1, dim>(Point<dim>::unit_vector(x[0] > 0.5)));
      }
    state.phi.update_ghost_values();
    state.v.update_ghost_values();
    const auto before = n_open(state, h);
    close_air_pockets(state, data, 0.06, reach);
    const auto slow = n_open(state, h);
    close_air_pockets(state, data, 0.3, reach);
    const auto after = n_open(state, h);
    out() << dim << "D: a slot that a step fills a fifth of " << (slow == before ? "stays" : "IS CLOSED")
          << ", nearly all " << (after[0] == 0 ? "is closed" : "STAYS") << ", nothing "
          << (after[1] == before[1] && before[1] > 0 ? "stays" : "IS CLOSED") << std::endl;
  }
} // namespace

void
start(const int, char **)
{
  on_1_2_3_ranks([](const MPI_Comm &comm) {
    check<2>(comm);
    check<3>(comm);
    check_slots<2>(comm);
    check_slots<3>(comm);
  });
}

const Test test("surface/air_pockets", start);
} // namespace tests::surface_air_pockets
