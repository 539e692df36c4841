// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/work.h>
#include <treacle/mesh/dual_weights.h>
#include <treacle/mesh/imported_mesh.h>
#include <treacle/mesh/lattice_mesh.h>
#include <treacle/mesh/make_locator.h>
#include <treacle/mesh/mesh.h>
#include <treacle/mesh/mesh_numbering.h>

#include <numeric>

namespace treacle
{
  template <int dim>
  struct Mesh<dim>::Maker
  {
    Mesh &mesh;

    void
    make(const MeshCells<dim> &mesh_cells);

    void
    fill_cells(const MeshCells<dim> &mesh_cells, const MeshNumbering<dim> &numbering);

    void
    fill_cell(const MeshCells<dim>                &mesh_cells,
              const typename MeshCells<dim>::Cell &from,
              const LocalIndex                     cell);

    void
    fill_faces();

    /// All that the first cell of a face tells, whose node opposite is its node i.
    void
    fill_face(const LocalIndex face, const LocalIndex cell, const unsigned int i);

    void
    agree_on_ghost_faces();

    /// Dual lengths below @p least, a part of the distance of the barycentres along the
    /// normal, are lengthened to it; 0: none.
    void
    measure_dual_edges(const double least);

    /// The second cell's dual centre; on the box, below the first's.
    Point<dim>
    end_of_dual_edge(const LocalIndex face) const;

    void
    fill_nodes();

    /// Around all nodes.
    BoundingBox<dim>
    find_box() const;
  };

  template <int dim>
  Mesh<dim>::Mesh(std::shared_ptr<const Octree<dim>> octree)
    : comm(octree->communicator())
    , tree(std::move(octree))
    , around({tree->parameters().lower_corner, tree->parameters().upper_corner})
    , finest(tree->finest_size())
    , largest_at_surface(tree->parameters().size_of(tree->parameters().coarsest_at_surface()))
  {
    auto lattice = std::make_unique<LatticeMesh<dim>>(tree);
    Maker maker{*this};
    maker.make(lattice->take_cells());
    maker.measure_dual_edges(0);
    finder = make_locator<dim>(*this, std::move(lattice));
  }

  template <int dim>
  Mesh<dim>::Mesh(const MPI_Comm &comm, const std::string &file)
    : comm(comm)
  {
    ImportedMesh<dim> imported(comm, file);
    finest             = imported.mean_size;
    largest_at_surface = imported.largest_size;
    Maker maker{*this};
    maker.make(imported.cells);
    maker.measure_dual_edges(least_dual_length);
    around = maker.find_box();
    finder = make_locator<dim>(*this, nullptr);
  }

  template <int dim>
  void
  Mesh<dim>::Maker::make(const MeshCells<dim> &mesh_cells)
  {
    const MeshNumbering<dim> numbering(mesh.comm, mesh_cells);
    Work::here().cells_made += numbering.cells->locally_owned_size();
    mesh.nodes = numbering.nodes;
    mesh.faces = numbering.faces;
    mesh.cells = numbering.cells;
    fill_cells(mesh_cells, numbering);
    fill_faces();
    fill_nodes();
  }

  template <int dim>
  void
  Mesh<dim>::Maker::fill_cells(const MeshCells<dim>     &mesh_cells,
                               const MeshNumbering<dim> &numbering)
  {
    const unsigned int n = mesh_cells.cells.size();
    mesh.cell_nodes.resize(n);
    mesh.cell_faces.resize(n);
    mesh.cell_volume.resize(n);
    mesh.cell_number.resize(n);
    mesh.cell_size.resize(n);
    mesh.cell_dual.resize(n);
    mesh.cell_gradients.resize(n);
    const unsigned int n_nodes = mesh.nodes->locally_owned_size() + mesh.nodes->n_ghost_indices();
    mesh.node_position.resize(n_nodes);
    mesh.node_key.resize(n_nodes);
    mesh.node_sides.resize(n_nodes);
    mesh.face_side.assign(mesh.faces->locally_owned_size() + mesh.faces->n_ghost_indices(),
                          no_side);
    for (unsigned int i = 0; i < n; ++i)
      {
        const LocalIndex c = numbering.cell[i];
        mesh.cell_nodes[c] = numbering.cell_nodes[i];
        mesh.cell_faces[c] = numbering.cell_faces[i];
        fill_cell(mesh_cells, mesh_cells.cells[i], c);
      }
  }

  template <int dim>
  void
  Mesh<dim>::Maker::fill_cell(const MeshCells<dim>                &mesh_cells,
                              const typename MeshCells<dim>::Cell &from,
                              const LocalIndex                     c)
  {
    VertexValues<dim> weight;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        const LocalIndex node                 = mesh.cell_nodes[c][v];
        const auto      &vertex               = mesh_cells.vertices[from.vertex[v]];
        mesh.node_key[node]                   = vertex.key;
        mesh.node_position[node]              = vertex.position;
        mesh.node_sides[node]                 = vertex.walls;
        mesh.face_side[mesh.cell_faces[c][v]] = from.wall[v];
        weight[v]                             = vertex.weight;
      }
    const Simplex<dim> x   = mesh.cell_vertices(c);
    mesh.cell_volume[c]    = signed_volume<dim>(x);
    mesh.cell_number[c]    = from.number;
    mesh.cell_size[c]      = from.size;
    mesh.cell_dual[c]      = weighted_circumcentre<dim>(x, weight);
    mesh.cell_gradients[c] = basis_gradients<dim>(x);
  }

  template <int dim>
  void
  Mesh<dim>::Maker::fill_face(const LocalIndex f, const LocalIndex c, const unsigned int i)
  {
    std::array<Point<dim>, dim> x;
    for (unsigned int k = 0, v = 0; v <= dim; ++v)
      if (v != i)
        {
          mesh.face_nodes[f][k] = mesh.cell_nodes[c][v];
          x[k++]                = mesh.node_position[mesh.cell_nodes[c][v]];
        }
    Tensor<1, dim> a = area_vector<dim>(x);
    if (a * (x[0] - mesh.node_position[mesh.cell_nodes[c][i]]) < 0)
      a = -a;
    mesh.face_area[f]   = a.norm();
    mesh.face_normal[f] = a / mesh.face_area[f];
  }

  template <int dim>
  void
  Mesh<dim>::Maker::fill_faces()
  {
    const unsigned int n = mesh.faces->locally_owned_size() + mesh.faces->n_ghost_indices();
    mesh.face_cells.assign(n, {{invalid, invalid}});
    mesh.face_nodes.resize(n);
    mesh.face_area.resize(n);
    mesh.face_normal.resize(n);

    // mesh.cells in the order of their number: the lower comes first
    std::vector<LocalIndex> order(mesh.cell_nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
      return mesh.cell_number[a] < mesh.cell_number[b];
    });
    for (const LocalIndex c : order)
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const LocalIndex f        = mesh.cell_faces[c][i];
          const bool       is_first = mesh.face_cells[f][0] == invalid;
          mesh.face_cells[f][is_first ? 0 : 1] = c;
          if (is_first)
            fill_face(f, c, i);
        }
    agree_on_ghost_faces();
  }

  template <int dim>
  void
  Mesh<dim>::Maker::agree_on_ghost_faces()
  {
    // a ghost's outer face: its owner knows which cell is the lower
    Vector lower = mesh.zeros(mesh.faces);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      lower.local_element(f) = mesh.cell_number[mesh.face_cells[f][0]];
    lower.update_ghost_values();
    for (LocalIndex f = 0; f < mesh.face_cells.size(); ++f)
      if (lower.local_element(f) != mesh.cell_number[mesh.face_cells[f][0]])
        {
          mesh.face_cells[f]  = {{invalid, mesh.face_cells[f][0]}};
          mesh.face_normal[f] = -mesh.face_normal[f];
        }
  }

  template <int dim>
  Point<dim>
  Mesh<dim>::Maker::end_of_dual_edge(const LocalIndex f) const
  {
    const Point<dim> &o = mesh.cell_dual[mesh.face_cells[f][0]];
    const LocalIndex  j = mesh.face_cells[f][1];
    return j == invalid ?
             Point<dim>(o + ((mesh.face_centre(f) - o) * mesh.face_normal[f]) * mesh.face_normal[f]) :
             mesh.cell_dual[j];
  }

  template <int dim>
  void
  Mesh<dim>::Maker::measure_dual_edges(const double least)
  {
    Vector length = mesh.zeros(mesh.faces);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      {
        const auto &[i, j] = mesh.face_cells[f];
        double &l          = length.local_element(f);
        l                  = (end_of_dual_edge(f) - mesh.cell_dual[i]) * mesh.face_normal[f];
        if (j == invalid || least == 0)
          continue;
        const Tensor<1, dim> way      = barycentre<dim>(mesh.cell_vertices(j)) - barycentre<dim>(mesh.cell_vertices(i));
        const double         shortest = least * (way * mesh.face_normal[f]);
        mesh.n_clamped_dual_lengths += l < shortest;
        l = std::max(l, shortest);
      }
    mesh.n_clamped_dual_lengths = Utilities::MPI::sum(mesh.n_clamped_dual_lengths, mesh.comm);
    length.update_ghost_values();
    mesh.face_dual_length.resize(mesh.face_cells.size());
    for (LocalIndex f = 0; f < mesh.face_cells.size(); ++f)
      mesh.face_dual_length[f] = length.local_element(f);
  }

  template <int dim>
  void
  Mesh<dim>::Maker::fill_nodes()
  {
    mesh.node_cell_start.assign(mesh.n_owned_nodes() + 1, 0);
    for (const auto &list : mesh.cell_nodes)
      for (const LocalIndex node : list)
        if (node < mesh.n_owned_nodes())
          ++mesh.node_cell_start[node + 1];
    std::partial_sum(mesh.node_cell_start.begin(), mesh.node_cell_start.end(), mesh.node_cell_start.begin());
    mesh.node_cells.resize(mesh.node_cell_start.back());
    std::vector<unsigned int> next(mesh.node_cell_start.begin(), mesh.node_cell_start.end() - 1);
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      for (const LocalIndex node : mesh.cell_nodes[c])
        if (node < mesh.n_owned_nodes())
          mesh.node_cells[next[node]++] = c;
  }

  template <int dim>
  BoundingBox<dim>
  Mesh<dim>::Maker::find_box() const
  {
    std::array<double, 2 * dim> most; // of -x and x
    most.fill(-std::numeric_limits<double>::infinity());
    for (const Point<dim> &x : mesh.node_position)
      for (unsigned int d = 0; d < dim; ++d)
        {
          most[2 * d]     = std::max(most[2 * d], -x[d]);
          most[2 * d + 1] = std::max(most[2 * d + 1], x[d]);
        }
    MPI_Allreduce(MPI_IN_PLACE, most.data(), most.size(), MPI_DOUBLE, MPI_MAX, mesh.comm);
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = -most[2 * d];
        upper[d] = most[2 * d + 1];
      }
    return BoundingBox<dim>({lower, upper});
  }

  template class Mesh<2>;
  template class Mesh<3>;
} // namespace treacle
