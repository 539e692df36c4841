// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_node.h>
#include <treacle/fields/gradients.h>
#include <treacle/mesh/same_faces.h>
#include <treacle/transport/face_residual.h>

namespace treacle
{
  namespace
  {
    /// How far faces are from each other, in leaves. With 1 an inviscid drop that is stretched across the
    /// mesh shatters, with 1/4 it does not.
    constexpr double between_faces = 0.25;

    /// Of the change of velocity over a leaf: how much nodes may miss where leaves change size along the surface. Smooth flows have 0.05
    /// to 0.3; with 0.5 waves grow there that have 0.4 to 1.3.
    constexpr double most_missed = 0.25;

    /// What nodes missed of a face that the mesh before did not have.
    constexpr double no_face = std::numeric_limits<double>::quiet_NaN();

    /// Edge of the smaller leaf beside a face (m).
    template <int dim>
    double
    size_at_face(const Mesh<dim> &mesh, const LocalIndex face)
    {
      const auto &[first, second] = mesh.face_cells[face];
      return second == invalid ? mesh.cell_size[first] :
                                 std::min(mesh.cell_size[first], mesh.cell_size[second]);
    }

    /// Largest edge of the leaves around an owned node, if these have several sizes, or 0 (m).
    template <int dim>
    double
    size_where_leaves_change(const Mesh<dim> &mesh, const LocalIndex node)
    {
      constexpr double twice    = 1.5; // but for rounding
      double           smallest = std::numeric_limits<double>::max(), largest = 0;
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        {
          const double size = mesh.cell_size[mesh.node_cells[k]];
          smallest          = std::min(smallest, size);
          largest           = std::max(largest, size);
        }
      return largest > twice * smallest ? largest : 0.;
    }

    /// 1 at nodes within about a leaf of the surface around which leaves change size, and at those of the cells around them. Empty
    /// where the surface has leaves of one size. Collective.
    template <int dim>
    Vector
    where_leaves_change(const State<dim> &state, const LiquidDomain<dim> &domain)
    {
      constexpr double within = 1.1; // leaves; nodes lie at 1
      const Mesh<dim> &mesh   = domain.mesh;
      if (!mesh.is_lattice() || mesh.surface_size() == mesh.finest_size())
        return {};
      Vector there(mesh.nodes), around(mesh.nodes);
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        there.local_element(node) = std::abs(state.phi.local_element(node)) < within * size_where_leaves_change(mesh, node);
      there.update_ghost_values();
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        around.local_element(node) =
          any_around(domain.data, node, [&](const LocalIndex other) { return there.local_element(other) > 0; });
      around.update_ghost_values();
      return around;
    }

    /// The part of what nodes miss that is left after a time @p dt (s), while the liquid gets from one face to the next.
    template <int dim>
    double
    part_kept(const State<dim> &old, const LocalIndex face, const double dt)
    {
      const double moved = dt * mean_at_face(*old.mesh, old.v, face).norm() / (between_faces * size_at_face(*old.mesh, face));
      return std::max(0., 1 - moved);
    }

    /// How much nodes may miss of a liquid face where leaves change size (m/s).
    template <int dim>
    double
    most_there(const State<dim> &old, const LocalIndex face)
    {
      const Mesh<dim> &mesh    = *old.mesh;
      double           largest = 0;
      for (const LocalIndex c : mesh.face_cells[face])
        if (c != invalid)
          largest = std::max(largest, velocity_gradient(mesh, c, old.v).norm());
      return most_missed * largest * size_at_face(mesh, face);
    }

    /// u - P v of a face.
    template <int dim>
    double
    missed(const State<dim> &state, const LocalIndex face)
    {
      return state.u.local_element(face) - face_velocity(*state.mesh, state.v, face);
    }
  } // namespace

  template <int dim>
  std::vector<LocalIndex>
  faces_that_matter(const State<dim> &state)
  {
    const Mesh<dim>        &mesh  = *state.mesh;
    const double            reach = 2 * mesh.surface_size();
    std::vector<LocalIndex> faces;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (std::any_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const auto node) {
            return state.phi.local_element(node) < reach;
          }))
        faces.push_back(f);
    return faces;
  }

  template <int dim>
  Vector
  missed_by_nodes(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    const Mesh<dim> &mesh   = *state.mesh;
    Vector           result = mesh.zeros(mesh.faces);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        result.local_element(f) = missed(state, f);
    result.update_ghost_values();
    return result;
  }

  template <int dim>
  Vector
  missed_by_nodes(const State<dim> &state, const LiquidDomain<dim> &domain, const State<dim> &next)
  {
    Vector missed = missed_by_nodes(state, domain);
    if (next.mesh == state.mesh)
      return missed;
    const std::vector<LocalIndex> faces  = faces_that_matter(next);
    const std::vector<double>     values = values_of_same_faces(domain.mesh, missed, *next.mesh, faces, no_face);
    Vector                        result = next.mesh->zeros(next.mesh->faces);
    for (unsigned int i = 0; i < faces.size(); ++i)
      result.local_element(faces[i]) = values[i];
    result.update_ghost_values();
    return result;
  }

  template <int dim>
  void
  keep_what_nodes_miss(const State<dim>              &old,
                       const LiquidDomain<dim>       &domain,
                       const BackwardDifference      &difference,
                       const Mesh<dim>               &other,
                       const std::vector<LocalIndex> &faces,
                       Vector                        &u)
  {
    const Mesh<dim> &mesh      = domain.mesh;
    const bool       remembers = difference.before != 0 && old.before->u;
    const Vector     is_graded = where_leaves_change(old, domain);
    Vector           kept      = mesh.zeros(mesh.faces);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        {
          const double now = missed(old, f), before = remembers ? old.before->u->local_element(f) : no_face;
          const double all = part_kept(old, f, difference.dt) *
                             (std::isnan(before) ? now : difference.now * now + difference.before * before);
          const bool   leaves_change =
            is_graded.size() > 0 && std::any_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const LocalIndex node) {
              return is_graded.local_element(node) > 0;
            });
          const double most     = leaves_change ? most_there(old, f) : std::abs(all);
          kept.local_element(f) = std::clamp(all, -most, most);
        }
    if (&other == &mesh)
      {
        for (const LocalIndex f : faces)
          u.local_element(f) += kept.local_element(f);
        return;
      }
    kept.update_ghost_values();
    const std::vector<double> values = values_of_same_faces(mesh, kept, other, faces, 0);
    for (unsigned int i = 0; i < faces.size(); ++i)
      u.local_element(faces[i]) += values[i];
  }

  template <int dim>
  void
  forget_missed(State<dim> &state, const LiquidDomain<dim> &domain, const Vector &blow)
  {
    const Mesh<dim> &mesh = *state.mesh;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f) &&
          std::any_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const auto node) {
            return blow.local_element(node) != 0;
          }))
        state.before->u->local_element(f) = missed(state, f);
    state.before->u->update_ghost_values();
  }

#define INSTANTIATE(dim)                                                             \
  template Vector missed_by_nodes(const State<dim> &, const LiquidDomain<dim> &);    \
  template Vector missed_by_nodes(const State<dim> &, const LiquidDomain<dim> &, const State<dim> &); \
  template std::vector<LocalIndex> faces_that_matter(const State<dim> &);            \
  template void   forget_missed(State<dim> &, const LiquidDomain<dim> &, const Vector &); \
  template void   keep_what_nodes_miss(const State<dim> &,                           \
                                     const LiquidDomain<dim> &,                    \
                                     const BackwardDifference &,                   \
                                     const Mesh<dim> &,                            \
                                     const std::vector<LocalIndex> &,              \
                                     Vector &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
