// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/steps/extrapolation.h>
#include <treacle/steps/reconstruction.h>

namespace treacle
{
  template <int dim>
  void
  Reconstruction<dim>::Parameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Advection");
    prm.add_parameter("Scheme",
                      scheme,
                      "How velocity and level set are carried along.",
                      Patterns::Selection("semi-Lagrangian"));
    prm.add_parameter("Reconstruction",
                      method,
                      "Node velocity from face velocity: the fit that is exact for rigid motions, "
                      "or least squares at each node.",
                      Patterns::Selection("face fitted|least squares"));
    prm.leave_subsection();
  }

  namespace
  {
    /// Nodes that the faces do not determine receive the mean of their neighbours.
    template <int dim>
    void
    fill_invalid(const LiquidDomain<dim>          &domain,
                 const std::vector<unsigned char> &is_valid,
                 NodeVector<dim>                  &v)
    {
      const Mesh<dim> &mesh = domain.mesh;
      for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
        {
          if (is_valid[node] || !domain.is_active_node[node])
            continue;
          Tensor<1, dim> sum;
          double         n = 0;
          for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
            for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
              if (is_valid[other])
                {
                  sum += v.value(other);
                  ++n;
                }
          if (n > 0)
            v.set(node, Tensor<1, dim>(sum / n));
        }
      v.update_ghost_values();
    }
  } // namespace

  template <int dim>
  void
  Reconstruction<dim>::advance(State<dim> &state, const FaceFit<dim> &fit, const double reach) const
  {
    if (prm.method == "face fitted")
      fit.solve(state.u, state.v);
    else
      fill_invalid(fit.domain, least_squares(fit.domain, state.u, state.v), state.v);
    extrapolate(state, fit.domain, reach);
  }

  template class Reconstruction<2>;
  template class Reconstruction<3>;
} // namespace treacle
