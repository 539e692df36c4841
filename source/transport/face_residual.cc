// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/face_node.h>
#include <treacle/mesh/same_faces.h>
#include <treacle/transport/face_residual.h>

namespace treacle
{
  namespace
  {
    /// How far faces are from each other, in leaves. With 1 an inviscid drop that is stretched across the
    /// mesh shatters, with 1/4 it does not.
    constexpr double between_faces = 0.25;

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
    Vector           kept      = mesh.zeros(mesh.faces);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (domain.is_liquid_face(f))
        {
          const double speed = mean_at_face(mesh, old.v, f).norm(),
                       moved = difference.dt * speed / (between_faces * size_at_face(mesh, f));
          const double now   = missed(old, f), before = remembers ? old.before->u->local_element(f) : no_face;
          kept.local_element(f) =
            std::max(0., 1 - moved) * (std::isnan(before) ? now : difference.now * now + difference.before * before);
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
