// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_liquid_domain_h
#define treacle_fields_liquid_domain_h

#include <treacle/fields/cut_cells.h>
#include <treacle/fields/mesh_data.h>
#include <treacle/fields/state.h>
#include <treacle/fields/viscosity_jump.h>
#include <treacle/mesh/dual_part.h>

#include <map>

namespace treacle
{
  /// Where the liquid is, and how much of it a cell, face and node carries:
  /// computed once for each surface. Arrays run over owned entries and ghosts.
  template <int dim>
  class LiquidDomain
  {
  public:
    /// Where solids hold the liquid: at their walls, which cut cells, or at the nodes
    /// inside them (Batty & Houston 2011).
    enum class Hold
    {
      walls,
      nodes
    };

    struct Parameters
    {
      Hold   hold          = Hold::walls;
      double minimum_theta = 1e-6; ///< bounds the liquid part of a dual edge from below

      /// Subsections Viscosity and Pressure.
      void
      add_parameters(ParameterHandler &prm);
    };

    /// Throws a UserError on all ranks where a density or viscosity makes no sense.
    /// @p data are of the state's mesh, and must outlive this object.
    LiquidDomain(const Parameters    &parameters,
                 const State<dim>    &state,
                 const MeshData<dim> &data,
                 const bool           emitters_rest = false);

    const MeshData<dim> &data;
    const Mesh<dim>     &mesh;
    const Scene<dim>    &scene;
    const double         minimum_theta;
    const bool           emitters_rest; ///< they pour nothing, and what is in them is liquid as any other

    // -- cells --
    std::vector<double>         liquid_volume;    ///< of {phi<0} outside solids (m^dim)
    std::vector<Point<dim>>     liquid_centre;    ///< its centroid, where there is some
    std::vector<double>         dual_distance;    ///< phi(o), extended linearly (m)
    std::vector<unsigned char>  is_pressure_cell; ///< wet, and phi(o) < 0
    std::vector<unsigned char>  is_active_cell;   ///< wet: with liquid
    /// Active, where neither pressure nor wall holds a node: of threads thinner than a cell.
    std::vector<unsigned char>  is_free_cell;
    std::vector<double>         viscosity;        ///< mean over the liquid part (Pa s)
    std::map<LocalIndex, ViscosityJump<dim>> viscosity_jumps; ///< in cells that no solid cuts
    std::vector<double>         density;          ///< kg/m^dim
    CutCells<dim>               cut_cells;        ///< by solids, if their walls hold

    // -- faces --
    std::vector<double> open_fraction; ///< alpha: part of the area outside solids and emitters
    std::vector<double> theta;         ///< liquid part of the dual edge, which may go on to the surface; of free faces that of the volume
    std::vector<double> face_mass;     ///< M_f = rho alpha A theta L (kg), rho along the liquid part; 0: no unknown
    /// Normal velocity where there is no unknown: of walls, solids, emitters.
    std::vector<double> solid_velocity;
    unsigned int        n_clamped_faces = 0; ///< theta clamped, over all ranks
    /// What solids that meet in a cell sweep out of its open part, less what the closed parts of its faces carry (m^dim/s).
    std::map<LocalIndex, double> closed_excess;

    // -- nodes --
    std::vector<unsigned char> is_active_node; ///< of an active cell
    std::vector<unsigned char> is_light_node;  ///< active, with almost no liquid around; owned nodes
    std::vector<double>        node_mass;      ///< lumped liquid mass (kg), owned nodes
    std::vector<double>        solid_distance; ///< positive outside solids
    std::vector<double>        held_distance;  ///< positive outside solids and emitters
    std::vector<double>        emitter_distance; ///< positive outside emitters at work; empty in a scene without any
    std::vector<unsigned char> is_emitter_node; ///< in an emitter at work
    /// Bit d is set where component d is prescribed (no slip, free slip, solids,
    /// emitters).
    std::vector<unsigned char>  constrained;
    std::vector<Tensor<1, dim>> prescribed; ///< the values

    bool
    is_liquid_face(const LocalIndex face) const
    {
      return face_mass[face] > 0;
    }

    /// Volume of the cell (m^dim), outside solids if their walls hold.
    double
    open_volume(const LocalIndex cell) const
    {
      return cut_cells.parts(cell).size() == 0 ? mesh.cell_volume[cell] :
                                                 cut_cells.open_volume(cell);
    }

    /// Of a liquid face that is owned: between free cells, or such a one and air.
    bool
    is_free_face(const LocalIndex face) const
    {
      const auto [i, j] = mesh.face_cells[face];
      return is_free_cell[i] + is_free_cell[j] == is_active_cell[i] + is_active_cell[j];
    }

    /// Of the dual edge of a face @p part, from the liquid's dual centre on; all of it where the pressure of both cells is liquid, or of neither.
    DualPart<dim>
    liquid_part(const LocalIndex face, const double part) const
    {
      const auto &[i, j]    = mesh.face_cells[face];
      const bool from_first = is_pressure_cell[i], is_whole = from_first == is_pressure_cell[j];
      const Tensor<1, dim> edge = (is_whole ? 1 : part) * mesh.face_dual_length[face] * mesh.face_normal[face];
      return from_first || is_whole ? DualPart<dim>{mesh.cell_dual[i], edge} : DualPart<dim>{mesh.cell_dual[j], -edge};
    }

    /// Of the volume of the cell.
    double
    liquid_fraction(const LocalIndex cell) const
    {
      return liquid_volume[cell] / mesh.cell_volume[cell];
    }

    /// closed_excess of any cell.
    double
    excess_of(const LocalIndex cell) const
    {
      const auto excess = closed_excess.find(cell);
      return excess == closed_excess.end() ? 0. : excess->second;
    }

    /// What the closed parts of faces carry out of a cell (m^dim/s), of solids, emitters and walls.
    double
    closed_outflow(const LocalIndex cell) const;

    /// Liquid volume over all ranks (m^dim).
    double
    total_volume() const;

    /// The same with walls, solids and emitters that do not move.
    std::shared_ptr<const LiquidDomain>
    with_walls_at_rest() const;

  private:
    void
    find_emitters(const double time);

    void
    measure_cells(const State<dim> &state);

    void
    measure_cell(const LocalIndex cell, const State<dim> &state);

    /// Viscosity and density of an active cell.
    void
    find_material(const LocalIndex cell, const State<dim> &state);

    /// theta of an owned open face beside an active cell, not yet bounded from below. Up to the surface, at most a leaf away,
    /// where the dual edge ends before that in the air.
    double
    liquid_part_of_dual_edge(const LocalIndex face) const;

    void
    measure_faces(const State<dim> &state);

    /// closed_excess.
    void
    find_meeting_solids(const double time);

    void
    find_free_cells();

    void
    measure_nodes();
  };
} // namespace treacle

#endif
