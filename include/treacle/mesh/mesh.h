// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_mesh_h
#define treacle_mesh_mesh_h

#include <treacle/geometry/simplex.h>
#include <treacle/mesh/mesh_cells.h>
#include <treacle/mesh/node_vector.h>
#include <treacle/mesh/octree.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/partitioner.h>

namespace treacle
{
  template <int dim>
  class Locator;

  /// A distributed simplex mesh as flat arrays, in the order of deal.II's partitioners: owned entries first, then the ghosts. Ghost cells
  /// are all that share a node with an owned cell. Never changed: a new surface makes a new mesh.
  template <int dim>
  class Mesh
  {
  public:
    using Partitioner = std::shared_ptr<const Utilities::MPI::Partitioner>;

    /// On the lattice of an octree. Collective.
    explicit Mesh(std::shared_ptr<const Octree<dim>> octree);

    /// From a file, see ImportedMesh. Throws a UserError on all ranks. Collective.
    Mesh(const MPI_Comm &comm, const std::string &file);

    Mesh(const Mesh &) = delete;

    /// Does it stand on a lattice, which is made anew where the surface goes?
    bool
    is_lattice() const
    {
      return tree != nullptr;
    }

    /// Of a lattice.
    const Octree<dim> &
    octree() const
    {
      Assert(is_lattice(), ExcMessage("This mesh was read from a file."));
      return *tree;
    }

    const Locator<dim> &
    locator() const
    {
      return *finder;
    }

    const MPI_Comm &
    communicator() const
    {
      return comm;
    }

    /// Around the mesh.
    const BoundingBox<dim> &
    box() const
    {
      return around;
    }

    Point<dim>
    middle() const
    {
      const auto &[lower, upper] = around.get_boundary_points();
      return lower + 0.5 * (upper - lower);
    }

    /// Leaf edge (m) of the finest level; from a file the mean cell size.
    double
    finest_size() const
    {
      return finest;
    }

    /// Size (m) of the largest cells that the surface may pass through.
    double
    surface_size() const
    {
      return largest_at_surface;
    }

    Partitioner nodes; ///< one value a node
    Partitioner faces; ///< one value a face
    Partitioner cells; ///< one value a cell

    // -- cells --
    std::vector<std::array<LocalIndex, dim + 1>>     cell_nodes;
    std::vector<std::array<LocalIndex, dim + 1>>     cell_faces; ///< face i is opposite node i
    std::vector<double>                              cell_volume;
    std::vector<GlobalIndex>                         cell_number; ///< in an order that no partition changes
    std::vector<double>                              cell_size; ///< edge of the leaf it stands on (m)
    std::vector<Point<dim>>                          cell_dual; ///< dual centre o
    std::vector<std::array<Tensor<1, dim>, dim + 1>> cell_gradients; ///< of the P1 basis

    // -- faces --
    /// The cell of lower and of higher number; the second is invalid on
    /// the box, the one beyond the ghost layer is invalid on a ghost's face.
    std::vector<std::array<LocalIndex, 2>>   face_cells;
    std::vector<std::array<LocalIndex, dim>> face_nodes;
    std::vector<double>                      face_area;
    std::vector<Tensor<1, dim>>              face_normal; ///< lower to higher cell, outward on the box
    std::vector<double>                      face_dual_length; ///< signed along the normal
    std::vector<unsigned char>               face_side; ///< kind of wall, see Walls, or no_side
    static constexpr unsigned char           no_side = Walls<dim>::none;
    /// Dual lengths that were lengthened, over all ranks; none on a lattice.
    GlobalIndex n_clamped_dual_lengths = 0;

    // -- nodes --
    std::vector<Point<dim>>     node_position;
    std::vector<VertexKey>      node_key;
    std::vector<unsigned short> node_sides; ///< bit w: on a wall of kind w

    /// Cells around owned node i (owned and ghost: all there are) from
    /// node_cell_start[i] to node_cell_start[i+1].
    std::vector<unsigned int> node_cell_start;
    std::vector<LocalIndex>   node_cells;

    Simplex<dim>
    cell_vertices(const LocalIndex cell) const
    {
      Simplex<dim> x;
      for (unsigned int i = 0; i <= dim; ++i)
        x[i] = node_position[cell_nodes[cell][i]];
      return x;
    }

    /// Barycentre.
    Point<dim>
    face_centre(const LocalIndex face) const
    {
      Point<dim> centre;
      for (const LocalIndex node : face_nodes[face])
        centre += node_position[node] / dim;
      return centre;
    }

    VertexValues<dim>
    values(const LocalIndex cell, const Vector &v) const
    {
      VertexValues<dim> w;
      for (unsigned int i = 0; i <= dim; ++i)
        w[i] = v.local_element(cell_nodes[cell][i]);
      return w;
    }

    VertexValues<dim>
    values(const LocalIndex cell, const std::vector<double> &v) const
    {
      VertexValues<dim> w;
      for (unsigned int i = 0; i <= dim; ++i)
        w[i] = v[cell_nodes[cell][i]];
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

    static Vector
    zeros(const Partitioner &partitioner)
    {
      return Vector(partitioner);
    }

  private:
    /// Fills the arrays.
    struct Maker;

    const MPI_Comm                      comm;
    std::shared_ptr<const Octree<dim>>  tree; ///< null for a mesh from a file
    std::shared_ptr<const Locator<dim>> finder;
    BoundingBox<dim>                    around;
    double                              finest, largest_at_surface;
  };
} // namespace treacle

#endif
