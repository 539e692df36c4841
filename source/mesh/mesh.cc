// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/imported_mesh.h>
#include <treacle/mesh/lattice_mesh.h>
#include <treacle/mesh/mesh.h>
#include <treacle/mesh/mesh_numbering.h>

#include <numeric>

namespace treacle
{
  namespace
  {
    /// An imported mesh need not be Delaunay, and cells of one circumcircle have no
    /// dual length at all: none is shorter than this part of the distance of the
    /// barycentres along the normal.
    constexpr double least_dual_length = 1e-2;
  } // namespace

  template <int dim>
  Mesh<dim>::Mesh(std::shared_ptr<const Octree<dim>> octree)
    : comm(octree->communicator())
    , tree(std::move(octree))
    , around({tree->parameters().lower_corner, tree->parameters().upper_corner})
    , finest(tree->finest_size())
    , largest_at_surface(finest)
  {
    auto lattice = std::make_unique<LatticeMesh<dim>>(tree);
    make(lattice->take_cells());
    measure_dual_edges(0);
    finder = make_locator<dim>(*this, std::move(lattice));
  }

  template <int dim>
  Mesh<dim>::Mesh(const MPI_Comm &comm, const std::string &file)
    : comm(comm)
  {
    ImportedMesh<dim> imported(comm, file);
    finest             = imported.mean_size;
    largest_at_surface = imported.largest_size;
    make(imported.cells);
    measure_dual_edges(least_dual_length);
    around = find_box();
    finder = make_locator<dim>(*this, nullptr);
  }

  template <int dim>
  void
  Mesh<dim>::make(const MeshCells<dim> &mesh_cells)
  {
    const MeshNumbering<dim> numbering(comm, mesh_cells);
    nodes = numbering.nodes;
    faces = numbering.faces;
    cells = numbering.cells;
    fill_cells(mesh_cells, numbering);
    fill_faces();
    fill_nodes();
  }

  template <int dim>
  void
  Mesh<dim>::fill_cells(const MeshCells<dim> &mesh_cells, const MeshNumbering<dim> &numbering)
  {
    const unsigned int n = mesh_cells.cells.size();
    cell_nodes.resize(n);
    cell_faces.resize(n);
    cell_volume.resize(n);
    cell_number.resize(n);
    cell_size.resize(n);
    cell_dual.resize(n);
    cell_gradients.resize(n);
    const unsigned int n_nodes = nodes->locally_owned_size() + nodes->n_ghost_indices();
    node_position.resize(n_nodes);
    node_key.resize(n_nodes);
    node_sides.resize(n_nodes);
    face_side.assign(faces->locally_owned_size() + faces->n_ghost_indices(), no_side);
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto       &from = mesh_cells.cells[i];
        const LocalIndex  c    = numbering.cell[i];
        VertexValues<dim> weight;
        cell_nodes[c] = numbering.cell_nodes[i];
        cell_faces[c] = numbering.cell_faces[i];
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const LocalIndex node       = cell_nodes[c][v];
            const auto      &vertex     = mesh_cells.vertices[from.vertex[v]];
            node_key[node]              = vertex.key;
            node_position[node]         = vertex.position;
            node_sides[node]            = vertex.walls;
            face_side[cell_faces[c][v]] = from.wall[v];
            weight[v]                   = vertex.weight;
          }
        const Simplex<dim> x = cell_vertices(c);
        cell_volume[c]       = signed_volume<dim>(x);
        cell_number[c]       = from.number;
        cell_size[c]         = from.size;
        cell_dual[c]         = weighted_circumcentre<dim>(x, weight);
        cell_gradients[c]    = basis_gradients<dim>(x);
      }
  }

  template <int dim>
  void
  Mesh<dim>::fill_face(const LocalIndex f, const LocalIndex c, const unsigned int i)
  {
    std::array<Point<dim>, dim> x;
    Point<dim>                  centre;
    for (unsigned int k = 0, v = 0; v <= dim; ++v)
      if (v != i)
        {
          face_nodes[f][k] = cell_nodes[c][v];
          x[k]             = node_position[cell_nodes[c][v]];
          centre += x[k++] / dim;
        }
    Tensor<1, dim> a = area_vector<dim>(x);
    if (a * (x[0] - node_position[cell_nodes[c][i]]) < 0)
      a = -a;
    face_area[f]   = a.norm();
    face_normal[f] = a / face_area[f];
    face_centre[f] = centre;
  }

  template <int dim>
  void
  Mesh<dim>::fill_faces()
  {
    const unsigned int n = faces->locally_owned_size() + faces->n_ghost_indices();
    face_cells.assign(n, {{invalid, invalid}});
    face_nodes.resize(n);
    face_area.resize(n);
    face_normal.resize(n);
    face_centre.resize(n);

    // cells in the order of their number: the lower comes first
    std::vector<LocalIndex> order(cell_nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
      return cell_number[a] < cell_number[b];
    });
    for (const LocalIndex c : order)
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const LocalIndex f        = cell_faces[c][i];
          const bool       is_first = face_cells[f][0] == invalid;
          face_cells[f][is_first ? 0 : 1] = c;
          if (is_first)
            fill_face(f, c, i);
        }
    agree_on_ghost_faces();
  }

  template <int dim>
  void
  Mesh<dim>::agree_on_ghost_faces()
  {
    // a ghost's outer face: its owner knows which cell is the lower
    Vector lower = zeros(faces);
    for (LocalIndex f = 0; f < n_owned_faces(); ++f)
      lower.local_element(f) = cell_number[face_cells[f][0]];
    lower.update_ghost_values();
    for (LocalIndex f = 0; f < face_cells.size(); ++f)
      if (lower.local_element(f) != cell_number[face_cells[f][0]])
        {
          face_cells[f]  = {{invalid, face_cells[f][0]}};
          face_normal[f] = -face_normal[f];
        }
  }

  template <int dim>
  Point<dim>
  Mesh<dim>::barycentre(const LocalIndex c) const
  {
    Point<dim> x;
    for (const LocalIndex node : cell_nodes[c])
      x += node_position[node] / (dim + 1);
    return x;
  }

  template <int dim>
  Point<dim>
  Mesh<dim>::end_of_dual_edge(const LocalIndex f) const
  {
    const Point<dim> &o = cell_dual[face_cells[f][0]];
    const LocalIndex  j = face_cells[f][1];
    return j == invalid ?
             Point<dim>(o + ((face_centre[f] - o) * face_normal[f]) * face_normal[f]) :
             cell_dual[j];
  }

  template <int dim>
  void
  Mesh<dim>::measure_dual_edges(const double least)
  {
    Vector length = zeros(faces);
    for (LocalIndex f = 0; f < n_owned_faces(); ++f)
      {
        const auto &[i, j] = face_cells[f];
        double &l          = length.local_element(f);
        l                  = (end_of_dual_edge(f) - cell_dual[i]) * face_normal[f];
        if (j == invalid || least == 0)
          continue;
        const double shortest = least * ((barycentre(j) - barycentre(i)) * face_normal[f]);
        n_clamped_dual_lengths += l < shortest;
        l = std::max(l, shortest);
      }
    n_clamped_dual_lengths = Utilities::MPI::sum(n_clamped_dual_lengths, comm);
    length.update_ghost_values();
    face_dual_length.resize(face_cells.size());
    for (LocalIndex f = 0; f < face_cells.size(); ++f)
      face_dual_length[f] = length.local_element(f);
  }

  template <int dim>
  void
  Mesh<dim>::fill_nodes()
  {
    node_cell_start.assign(n_owned_nodes() + 1, 0);
    for (const auto &list : cell_nodes)
      for (const LocalIndex node : list)
        if (node < n_owned_nodes())
          ++node_cell_start[node + 1];
    std::partial_sum(node_cell_start.begin(), node_cell_start.end(), node_cell_start.begin());
    node_cells.resize(node_cell_start.back());
    std::vector<unsigned int> next(node_cell_start.begin(), node_cell_start.end() - 1);
    for (LocalIndex c = 0; c < cell_nodes.size(); ++c)
      for (const LocalIndex node : cell_nodes[c])
        if (node < n_owned_nodes())
          node_cells[next[node]++] = c;
  }

  template <int dim>
  BoundingBox<dim>
  Mesh<dim>::find_box() const
  {
    std::array<double, 2 * dim> most; // of -x and x
    most.fill(-std::numeric_limits<double>::infinity());
    for (const Point<dim> &x : node_position)
      for (unsigned int d = 0; d < dim; ++d)
        {
          most[2 * d]     = std::max(most[2 * d], -x[d]);
          most[2 * d + 1] = std::max(most[2 * d + 1], x[d]);
        }
    MPI_Allreduce(MPI_IN_PLACE, most.data(), most.size(), MPI_DOUBLE, MPI_MAX, comm);
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
