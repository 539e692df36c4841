// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_dynamics_stokes_faces_h
#define treacle_dynamics_stokes_faces_h

#include <treacle/pressure/pressure_system.h>
#include <treacle/viscosity/hybrid.h>

namespace treacle
{
  /// What node velocity v and pressure q = step p do to one another in Stokes, through the
  /// liquid faces that pressure acts on: these alone, packed, for each iteration needs them.
  template <int dim>
  class StokesFaces
  {
  public:
    /// Copies what it needs. Collective.
    StokesFaces(const NodeSystem<dim>     &system,
                const PressureSystem<dim> &pressure,
                const Hybrid<dim>         &hybrid);

    /// From x to y, vectors of the unknowns of v and q: subtract P^T s B^T q from the
    /// momentum of free components, and set the outflow -B s P v - B (1 - s) M^-1 B^T q of the
    /// pressure cells. Collective.
    void
    couple(Vector &momentum, Vector &outflow, const Vector &x_v, const Vector &x_q) const;

    /// The outflow -B s P v of the pressure cells. Collective.
    void
    outflow(Vector &out_of_cells, const Vector &x_v) const;

  private:
    struct Face
    {
      std::array<LocalIndex, 2>   cells;
      std::array<LocalIndex, dim> nodes;
      double                      flux;     ///< open area (m^(dim-1))
      double                      mobility; ///< (1 - s) / M (1/kg)
      Tensor<1, dim>              share;    ///< s n / dim
    };

    bool
    is_free(const unsigned int row_node, const unsigned int component) const
    {
      return (system.domain.constrained[nodes[row_node]] >> component & 1) == 0;
    }

    /// Zero where v is prescribed.
    void
    scatter_velocity(const Vector &x_v) const;

    void
    scatter_pressure(const Vector &x_q) const;

    /// The sum over a face's nodes.
    Tensor<1, dim>
    sum_of_nodes(const Face &face) const
    {
      Tensor<1, dim> sum;
      for (const LocalIndex node : face.nodes)
        sum += v[node];
      return sum;
    }

    void
    add_flux(const Face &face, const double flux) const
    {
      out[face.cells[0]] += flux;
      out[face.cells[1]] -= flux;
    }

    const NodeSystem<dim>     &system;
    const PressureSystem<dim> &pressure;
    /// Of the mesh: those of the rows, in their order, then others. Faces know their places.
    std::vector<LocalIndex> nodes, cells;
    std::vector<Face>       faces;
    /// scratch
    mutable NodeVector<dim>             node_values;
    mutable Vector                      cell_values;
    mutable std::vector<Tensor<1, dim>> v, pushed;
    mutable std::vector<double>         q, out;
  };
} // namespace treacle

#endif
