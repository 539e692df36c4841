// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_rank_triangulation_h
#define treacle_mesh_rank_triangulation_h

#include <treacle/mesh/mesh_cells.h>

#include <deal.II/distributed/tria_base.h>

namespace treacle
{
  /// deal.II's triangulation of the cells of this rank and its ghosts, which has their
  /// indices, for DoFHandlers to number. parallel::fullydistributed::Triangulation makes the
  /// same from a description, whose cells it sorts twice, each comparison a search.
  template <int dim>
  class RankTriangulation : public parallel::DistributedTriangulationBase<dim>
  {
  public:
    /// Collective. @p mesh must outlive this object.
    RankTriangulation(const MPI_Comm &comm, const MeshCells<dim> &mesh);

    bool
    is_multilevel_hierarchy_constructed() const override
    {
      return false;
    }

    void
    save(const std::string &) const override;

    void
    load(const std::string &) override;

    void
    load(const std::string &, const bool) override;

  private:
    unsigned int
    coarse_cell_id_to_coarse_cell_index(const types::coarse_cell_id id) const override;

    types::coarse_cell_id
    coarse_cell_index_to_coarse_cell_id(const unsigned int index) const override;

    void
    update_cell_relations() override
    {}

    const std::vector<typename MeshCells<dim>::Cell> &mesh_cells;
  };
} // namespace treacle

#endif
