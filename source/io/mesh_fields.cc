// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/io/mesh_fields.h>

namespace treacle
{
  template <int dim>
  std::vector<Field>
  node_fields(const State<dim> &state, const std::vector<LocalIndex> &nodes)
  {
    Field phi{"phi", 1, {}}, velocity{"velocity", 3, {}};
    for (const LocalIndex node : nodes)
      {
        phi.values.push_back(state.phi.local_element(node));
        for (unsigned int d = 0; d < 3; ++d)
          velocity.values.push_back(d < dim ? state.v.component[d].local_element(node) :
                                              0);
      }
    return {phi, velocity};
  }

  template <int dim>
  std::vector<Field>
  cell_fields(const State<dim> &state, const LiquidDomain<dim> &domain)
  {
    const Mesh<dim>   &mesh = *state.mesh;
    const float        rank = Utilities::MPI::this_mpi_process(mesh.communicator());
    std::vector<Field> fields{{"pressure", 1, {}},
                              {"viscosity", 1, {}},
                              {"liquid_fraction", 1, {}},
                              {"rank", 1, {}}};
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      {
        fields[0].values.push_back(state.pressure.local_element(c));
        fields[1].values.push_back(domain.viscosity[c]);
        fields[2].values.push_back(domain.liquid_volume[c] / mesh.cell_volume[c]);
        fields[3].values.push_back(rank);
      }
    return fields;
  }

  template <int dim>
  std::vector<double>
  positions(const Mesh<dim> &mesh, const std::vector<LocalIndex> &nodes)
  {
    std::vector<double> x;
    x.reserve(3 * nodes.size());
    for (const LocalIndex node : nodes)
      for (unsigned int d = 0; d < 3; ++d)
        x.push_back(d < dim ? mesh.node_position[node][d] : 0);
    return x;
  }

  template std::vector<Field>
  node_fields(const State<2> &, const std::vector<LocalIndex> &);
  template std::vector<Field>
  cell_fields(const State<2> &, const LiquidDomain<2> &);
  template std::vector<double>
  positions(const Mesh<2> &, const std::vector<LocalIndex> &);

  template std::vector<Field>
  node_fields(const State<3> &, const std::vector<LocalIndex> &);
  template std::vector<Field>
  cell_fields(const State<3> &, const LiquidDomain<3> &);
  template std::vector<double>
  positions(const Mesh<3> &, const std::vector<LocalIndex> &);
} // namespace treacle
