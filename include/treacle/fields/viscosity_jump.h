// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_viscosity_jump_h
#define treacle_fields_viscosity_jump_h

#include <treacle/fields/carried_in_cell.h>

#include <functional>

namespace treacle
{
  /// The viscosity of a cell's liquid has two values, one on either side of a plane.
  template <int dim>
  struct ViscosityJump
  {
    VertexValues<dim>     distance;  ///< of the cell's vertices from the plane (m), negative on the first side
    std::array<double, 2> viscosity; ///< of the sides (Pa s)
    std::array<double, 2> part{};    ///< of the cell's liquid on them

    /// What a side counts as (Pa s): the stiffer one at most as a hundred times the other, which it would hold where the plane is askew by a few
    /// degrees.
    double
    counted(const unsigned int side) const
    {
      constexpr double most = 100;
      return std::min(viscosity[side], most * viscosity[1 - side]);
    }

    /// What liquid that is pressed together along the normal, and not sheared, feels (Pa s).
    double
    mean() const
    {
      return part[0] * counted(0) + part[1] * counted(1);
    }
  };

  /// Where @p viscosity, a formula that has the values @p at_vertices of a cell, jumps between these, if it does: it must do most of its change at a
  /// place on each edge.
  template <int dim>
  std::optional<ViscosityJump<dim>>
  find_jump(const Simplex<dim>                              &x,
            const VertexValues<dim>                         &at_vertices,
            const std::function<double(const Point<dim> &)> &viscosity);

  /// Jumps of what the liquid carries.
  template <int dim>
  class CarriedJumps
  {
  public:
    /// Of a field with up-to-date ghosts; @p liquid_volume is that in cells. Refers to all but the latter. Collective.
    CarriedJumps(const Mesh<dim> &mesh, const CarriedField &field, const std::vector<double> &liquid_volume);

    /// In a cell: P1 has the middle of the two values on the plane. Its normal is the mean over the cells around, for stiff liquid feels where single
    /// ones are askew by a few degrees.
    std::optional<ViscosityJump<dim>>
    operator()(const LocalIndex cell, const TwoValues &two) const;

  private:
    const Mesh<dim>    &mesh;
    const CarriedField &field;
    NodeVector<dim>     slope; ///< mean gradient around the nodes
  };
} // namespace treacle

#endif
