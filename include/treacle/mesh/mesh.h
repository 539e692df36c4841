// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_mesh_h
#define treacle_mesh_mesh_h

#include <treacle/geometry/simplex.h>
#include <treacle/mesh/face_normal_element.h>
#include <treacle/mesh/lattice.h>
#include <treacle/mesh/node_vector.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>

#include <map>

namespace treacle
{
  /// A distributed simplex mesh: deal.II's, and flat arrays for hot loops.
  /// Never changed: a new surface makes a new mesh. Arrays hold the owned
  /// entries first, then the ghosts, in the order of the partitioner's local
  /// indices; ghost cells are all that share a node with an owned cell.
  template <int dim>
  class Mesh
  {
  public:
    using Partitioner = std::shared_ptr<const Utilities::MPI::Partitioner>;

    /// Collective.
    explicit Mesh(std::shared_ptr<const Octree<dim>> octree);

    Mesh(const Mesh &) = delete;

    const Octree<dim> &
    octree() const
    {
      return *tree;
    }

    const MPI_Comm &
    communicator() const
    {
      return tree->communicator();
    }

    /// Leaf edge (m) of the finest level.
    double
    finest_size() const
    {
      return tree->finest_size();
    }

    parallel::fullydistributed::Triangulation<dim> triangulation;
    DoFHandler<dim>                                node_dofs;
    DoFHandler<dim>                                face_dofs;

    Partitioner nodes; ///< one value a node
    Partitioner faces; ///< one value a face
    Partitioner cells; ///< one value a cell, in an order that no partition changes

    // -- cells --
    std::vector<std::array<LocalIndex, dim + 1>>     cell_nodes;
    std::vector<std::array<LocalIndex, dim + 1>>     cell_faces; ///< face i is opposite node i
    std::vector<double>                              cell_volume;
    std::vector<double>                              cell_size; ///< edge of the leaf it stands on (m)
    std::vector<Point<dim>>                          cell_dual; ///< dual centre o
    std::vector<std::array<Tensor<1, dim>, dim + 1>> cell_gradients; ///< of the P1 basis

    // -- faces --
    /// The cell of lower and of higher global index; the second is invalid on
    /// the box, the one beyond the ghost layer is invalid on a ghost's face.
    std::vector<std::array<LocalIndex, 2>>   face_cells;
    std::vector<std::array<LocalIndex, dim>> face_nodes;
    std::vector<double>                      face_area;
    std::vector<Tensor<1, dim>>              face_normal; ///< lower to higher cell, outward on the box
    std::vector<Point<dim>>                  face_centre; ///< barycentre
    std::vector<double>                      face_dual_length; ///< signed along the normal
    std::vector<unsigned char>               face_side; ///< 2 axis + upper on the box, else no_side
    static constexpr unsigned char           no_side = 255;

    // -- nodes --
    std::vector<Point<dim>>    node_position;
    std::vector<VertexKey>     node_key;
    std::vector<unsigned char> node_sides; ///< bit 2 axis + upper: on that side of the box

    /// Cells around owned node i (owned and ghost: all there are) from
    /// node_cell_start[i] to node_cell_start[i+1].
    std::vector<unsigned int> node_cell_start;
    std::vector<LocalIndex>   node_cells;

    /// Cells over face f of a known leaf whose cells this rank holds.
    /// Owned leaves, and equal neighbours below one, are complete.
    void
    cells_over(const Leaf<dim>   &leaf,
               const unsigned int face,
               std::vector<LocalIndex> &result) const;

    Simplex<dim>
    cell_vertices(const LocalIndex cell) const
    {
      Simplex<dim> x;
      for (unsigned int i = 0; i <= dim; ++i)
        x[i] = node_position[cell_nodes[cell][i]];
      return x;
    }

    VertexValues<dim>
    values(const LocalIndex cell, const Vector &v) const
    {
      VertexValues<dim> w;
      for (unsigned int i = 0; i <= dim; ++i)
        w[i] = v.local_element(cell_nodes[cell][i]);
      return w;
    }

    unsigned int
    n_owned_cells() const
    {
      return cells->locally_owned_size();
    }

    unsigned int
    n_owned_faces() const
    {
      return faces->locally_owned_size();
    }

    unsigned int
    n_owned_nodes() const
    {
      return nodes->locally_owned_size();
    }

    /// A ghosted vector of zeros.
    static Vector
    zeros(const Partitioner &partitioner)
    {
      return Vector(partitioner);
    }

  private:
    struct CellRecord;

    std::vector<CellRecord>
    make_cells();

    void
    exchange_ghosts(std::vector<CellRecord> &records) const;

    void
    create_triangulation(const std::vector<CellRecord> &records);

    void
    number(const std::vector<CellRecord> &records);

    void
    fill_cells(const std::vector<CellRecord> &records);

    void
    fill_faces();

    void
    fill_nodes();

    std::shared_ptr<const Octree<dim>> tree;
    std::vector<unsigned int>          start; ///< of the lattice's owned leaves
    /// Ghost cells by the leaf they stand on, and its face.
    std::map<std::pair<VertexKey, unsigned int>, std::vector<LocalIndex>> ghosts_over;
  };
} // namespace treacle

#endif
