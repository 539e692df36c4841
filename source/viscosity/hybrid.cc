// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/connected_liquid.h>
#include <treacle/fields/face_node.h>
#include <treacle/viscosity/hybrid.h>

#include <algorithm>

namespace treacle
{
  namespace
  {
    // measured: doc/method.md
    constexpr double drag = 20, more_at_surface = 30;
    /// Bounds the drag from below, for liquids that have no viscosity.
    constexpr double least_share = 1e-8;
    /// Weight of a face that takes no part, of its mass: with 1e-8 a tip beyond the cells that have a
    /// pressure spins about the node it hangs on.
    constexpr double idle = 1e-3;

    /// Is a face between a cell that has a pressure and one that has none, away from walls and solids?
    template <int dim>
    bool
    is_at_surface(const LiquidDomain<dim> &domain, const LocalIndex face)
    {
      const auto &[first, second] = domain.mesh.face_cells[face];
      const auto &nodes           = domain.mesh.face_nodes[face];
      return second != invalid && domain.is_pressure_cell[first] != domain.is_pressure_cell[second] &&
             std::all_of(nodes.begin(), nodes.end(), [&](const LocalIndex n) { return domain.constrained[n] == 0; });
    }
  } // namespace

  template <int dim>
  Hybrid<dim>::Hybrid(const NodeSystem<dim>                     &system,
                      const typename NodeSystem<dim>::Stiffness &stiffness,
                      const double                               step,
                      const Faces                                faces)
    : system(system)
    , is_idle(find_idle(faces))
  {
    const LiquidDomain<dim> &domain = system.domain;
    const Mesh<dim>         &mesh   = domain.mesh;
    Vector                   part = mesh.zeros(mesh.faces), weights = part, other_part = part;
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      {
        if (!domain.is_liquid_face(f))
          continue;
        double       nu = 0, h = std::numeric_limits<double>::max();
        unsigned int n = 0;
        for (const LocalIndex c : mesh.face_cells[f])
          if (c != invalid && domain.is_active_cell[c])
            {
              nu += domain.viscosity[c] / domain.density[c];
              h = std::min(h, mesh.cell_size[c]);
              ++n;
            }
        const double spread = n > 0 ? nu / n * step / (h * h) : 0;
        const double more   = faces == Faces::under_pressure && is_at_surface(domain, f) ? more_at_surface : 0;
        const double ratio  = (1 + more * Skin<dim>::stiff_part(spread)) * drag * spread;
        const double s = std::max(ratio / (1 + ratio), least_share);
        part.local_element(f)       = s;
        other_part.local_element(f) = std::min(1 / (1 + ratio), 1 - least_share);
        weights.local_element(f)    = domain.face_mass[f] * (is_idle[f] ? idle * s : s);
      }
    part.update_ghost_values();
    weights.update_ghost_values();
    other_part.update_ghost_values();
    for (LocalIndex f = 0; f < mesh.face_cells.size(); ++f)
      {
        share.push_back(part.local_element(f));
        rest.push_back(other_part.local_element(f));
        weight.push_back(weights.local_element(f));
      }
    stiff = system.assemble(NodeSystem<dim>::Mass::faces, stiffness, weight);
  }

  template <int dim>
  std::vector<unsigned char>
  Hybrid<dim>::find_idle(const Faces faces) const
  {
    const LiquidDomain<dim>   &domain = system.domain;
    const Mesh<dim>           &mesh   = domain.mesh;
    std::vector<unsigned char> result(mesh.n_owned_faces(), 0);
    if (faces == Faces::all)
      return result;
    const Numbering       active(mesh.cells, domain.is_active_cell);
    const Vector          label = label_connected(domain, active);
    std::set<GlobalIndex> here;
    for (const LocalIndex c : active.owned)
      if (domain.is_pressure_cell[c])
        here.insert(label.local_element(c));
    const std::set<GlobalIndex> with_pressure = everywhere(mesh.communicator(), here);
    for (LocalIndex f = 0; f < result.size(); ++f)
      {
        if (!domain.is_liquid_face(f))
          continue;
        bool is_beside_pressure = false, is_connected_to_pressure = false;
        for (const LocalIndex c : mesh.face_cells[f])
          if (c != invalid && domain.is_active_cell[c])
            {
              is_beside_pressure = is_beside_pressure || domain.is_pressure_cell[c];
              is_connected_to_pressure =
                is_connected_to_pressure || with_pressure.count(label.local_element(c)) > 0;
            }
        result[f] =
          is_connected_to_pressure && !is_beside_pressure && !domain.is_free_face(f);
      }
    return result;
  }

  template <int dim>
  Vector
  Hybrid<dim>::right_hand_side(const Vector &u, const NodeVector<dim> &v) const
  {
    const Mesh<dim> &mesh = system.domain.mesh;
    Vector           pull = mesh.zeros(mesh.faces);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (system.domain.is_liquid_face(f))
        pull.local_element(f) = is_idle[f] ? face_velocity(mesh, v, f) : u.local_element(f);
    pull.update_ghost_values();
    return system.right_hand_side(system.face_momentum(pull, weight), stiff);
  }

  template <int dim>
  void
  Hybrid<dim>::drag_faces(State<dim>                                &state,
                          const typename NodeSystem<dim>::Stiffness &stiffness,
                          Reactions<dim>                            *reactions) const
  {
    const Vector old_u = state.u;
    old_u.update_ghost_values();
    for (LocalIndex f = 0; f < system.domain.mesh.n_owned_faces(); ++f)
      if (system.domain.is_liquid_face(f))
        state.u.local_element(f) = rest[f] * state.u.local_element(f) +
                                   share[f] * face_velocity(system.domain.mesh, state.v, f);
    state.u.update_ghost_values();
    if (reactions != nullptr)
      {
        reactions->add_stress(stiffness, state.v);
        reactions->add_inertia(system, old_u, state.u);
      }
  }

  template class Hybrid<2>;
  template class Hybrid<3>;
} // namespace treacle
