// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/dynamics/stokes_faces.h>

namespace treacle
{
  namespace
  {
    /// Numbers those that are asked for, in the order in which they are first.
    class Places
    {
    public:
      Places(std::vector<LocalIndex> &members, const unsigned int n)
        : members(members)
        , place(n, invalid)
      {}

      LocalIndex
      operator()(const LocalIndex member)
      {
        if (place[member] == invalid)
          {
            place[member] = members.size();
            members.push_back(member);
          }
        return place[member];
      }

    private:
      std::vector<LocalIndex> &members;
      std::vector<LocalIndex>  place;
    };
  } // namespace

  template <int dim>
  StokesFaces<dim>::StokesFaces(const NodeSystem<dim>     &system,
                                const PressureSystem<dim> &pressure,
                                const Hybrid<dim>         &hybrid)
    : system(system)
    , pressure(pressure)
    , node_values(system.domain.mesh.nodes)
    , cell_values(system.domain.mesh.zeros(system.domain.mesh.cells))
  {
    const LiquidDomain<dim> &domain = system.domain;
    const Mesh<dim>         &mesh   = domain.mesh;
    Places                   node_place(nodes, mesh.node_position.size());
    Places                   cell_place(cells, mesh.cell_nodes.size());
    // the rows first
    for (const LocalIndex node : system.nodes())
      node_place(node);
    for (const LocalIndex cell : pressure.cells())
      cell_place(cell);
    for (LocalIndex f = 0; f < mesh.face_cells.size(); ++f)
      {
        const auto &sides = mesh.face_cells[f];
        const bool  is_ours =
          std::any_of(sides.begin(), sides.end(), [&](const LocalIndex c) { return c < mesh.n_owned_cells(); }) ||
          std::any_of(mesh.face_nodes[f].begin(), mesh.face_nodes[f].end(), [&](const LocalIndex node) {
            return node < mesh.n_owned_nodes();
          });
        if (!is_ours || !domain.is_liquid_face(f) || !pressure.is_unknown(f))
          continue;
        Face face;
        for (unsigned int i = 0; i < dim; ++i)
          face.nodes[i] = node_place(mesh.face_nodes[f][i]);
        for (unsigned int i = 0; i < 2; ++i)
          face.cells[i] = cell_place(sides[i]);
        face.flux     = domain.open_fraction[f] * mesh.face_area[f];
        face.mobility = hybrid.rest[f] / domain.face_mass[f];
        face.share    = hybrid.share[f] / dim * mesh.face_normal[f];
        faces.push_back(face);
      }
    v.resize(nodes.size());
    pushed.resize(nodes.size());
    q.resize(cells.size());
    out.resize(cells.size());
  }

  template <int dim>
  void
  StokesFaces<dim>::scatter_velocity(const Vector &x_v) const
  {
    for (unsigned int i = 0; i < system.nodes().size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        node_values.component[d].local_element(nodes[i]) =
          is_free(i, d) ? x_v.local_element(dim * i + d) : 0.;
    node_values.update_ghost_values();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      v[i] = node_values.value(nodes[i]);
  }

  template <int dim>
  void
  StokesFaces<dim>::scatter_pressure(const Vector &x_q) const
  {
    pressure.to_cells(x_q, cell_values);
    for (unsigned int i = 0; i < cells.size(); ++i)
      q[i] = cell_values.local_element(cells[i]);
  }

  template <int dim>
  void
  StokesFaces<dim>::outflow(Vector &out_of_cells, const Vector &x_v) const
  {
    scatter_velocity(x_v);
    std::fill(out.begin(), out.end(), 0.);
    for (const Face &face : faces)
      add_flux(face, face.flux * (face.share * sum_of_nodes(face)));
    for (unsigned int i = 0; i < pressure.cells().size(); ++i)
      out_of_cells.local_element(i) = -out[i];
  }

  template <int dim>
  void
  StokesFaces<dim>::couple(Vector       &momentum,
                           Vector       &outflow,
                           const Vector &x_v,
                           const Vector &x_q) const
  {
    scatter_velocity(x_v);
    scatter_pressure(x_q);
    std::fill(pushed.begin(), pushed.end(), Tensor<1, dim>());
    std::fill(out.begin(), out.end(), 0.);
    for (const Face &face : faces)
      {
        const double push = face.flux * (q[face.cells[0]] - q[face.cells[1]]); // B^T q
        for (const LocalIndex node : face.nodes)
          pushed[node] += push * face.share;
        add_flux(face, face.flux * (face.share * sum_of_nodes(face) + face.mobility * push));
      }
    for (unsigned int i = 0; i < system.nodes().size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (is_free(i, d))
          momentum.local_element(dim * i + d) -= pushed[i][d];
    for (unsigned int i = 0; i < pressure.cells().size(); ++i)
      outflow.local_element(i) = -out[i];
  }

  template class StokesFaces<2>;
  template class StokesFaces<3>;
} // namespace treacle
