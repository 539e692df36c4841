// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/covering_boxes.h>
#include <treacle/mesh/imported_mesh.h>
#include <treacle/mesh/mesh.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <numeric>

namespace treacle
{
  template <int dim>
  Mesh<dim>::Mesh(std::shared_ptr<const Octree<dim>> octree)
    : triangulation(octree->communicator())
    , comm(octree->communicator())
    , around({octree->parameters().lower_corner, octree->parameters().upper_corner})
    , finest(octree->finest_size())
    , largest_at_surface(finest)
  {
    auto lattice = std::make_unique<LatticeMesh<dim>>(std::move(octree));
    make(lattice->take_cells());
    on_lattice = std::move(lattice);
    measure_dual_edges();
  }

  template <int dim>
  Mesh<dim>::Mesh(const MPI_Comm &comm, const std::string &file)
    : triangulation(comm)
    , comm(comm)
  {
    ImportedMesh<dim> imported(comm, file);
    finest             = imported.mean_size;
    largest_at_surface = imported.largest_size;
    make(imported.cells);
    measure_dual_edges();
    make_tree();
  }

  template <int dim>
  void
  Mesh<dim>::make(const MeshCells<dim> &mesh_cells)
  {
    triangulation.create_triangulation(describe(comm, mesh_cells));
    number(mesh_cells);
    fill_cells(mesh_cells);
    fill_faces();
    fill_nodes();
  }

  template <int dim>
  void
  Mesh<dim>::number(const MeshCells<dim> &mesh_cells)
  {
    node_dofs.reinit(triangulation);
    node_dofs.distribute_dofs(FE_SimplexP<dim>(1));
    face_dofs.reinit(triangulation);
    face_dofs.distribute_dofs(FaceNormalElement<dim>());

    const auto make = [&](const DoFHandler<dim> &dofs) {
      IndexSet relevant;
      DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      return std::make_shared<const Utilities::MPI::Partitioner>(
        dofs.locally_owned_dofs(), relevant, comm);
    };
    nodes = make(node_dofs);
    faces = make(face_dofs);

    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
    const GlobalIndex  n_owned = std::count_if(mesh_cells.cells.begin(),
                                              mesh_cells.cells.end(),
                                              [&](const auto &cell) { return cell.owner == rank; });
    GlobalIndex        first   = 0;
    MPI_Exscan(&n_owned, &first, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, comm);
    const GlobalIndex n_cells = Utilities::MPI::sum(n_owned, comm);
    IndexSet          owned(n_cells), ghosts(n_cells);
    owned.add_range(first, first + n_owned);
    std::vector<GlobalIndex> ids;
    for (const auto &cell : mesh_cells.cells)
      if (cell.owner != rank)
        ids.push_back(cell.id);
    ghosts.add_indices(ids.begin(), ids.end());
    cells = std::make_shared<const Utilities::MPI::Partitioner>(owned, ghosts, comm);
  }

  template <int dim>
  void
  Mesh<dim>::fill_cells(const MeshCells<dim> &mesh_cells)
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

    std::unordered_map<GlobalIndex, unsigned int> index_of;
    index_of.reserve(n);
    for (unsigned int i = 0; i < n; ++i)
      index_of[mesh_cells.cells[i].id] = i;

    std::array<unsigned int, dim + 1> opposite; // vertex of deal.II's face f
    for (unsigned int f = 0; f <= dim; ++f)
      opposite[f] = opposite_vertex<dim>(f);

    std::vector<GlobalIndex> node_ids(dim + 1), face_ids(dim + 1);
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const GlobalIndex id    = cell->id().get_coarse_cell_id();
        const LocalIndex  local = cells->global_to_local(id);
        const auto       &from  = mesh_cells.cells[index_of.at(id)];
        typename DoFHandler<dim>::active_cell_iterator(*cell, &node_dofs)->get_dof_indices(node_ids);
        typename DoFHandler<dim>::active_cell_iterator(*cell, &face_dofs)->get_dof_indices(face_ids);
        VertexValues<dim> weight;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const LocalIndex node          = nodes->global_to_local(node_ids[v]);
            const LocalIndex face          = faces->global_to_local(face_ids[v]);
            const auto      &vertex        = mesh_cells.vertices[from.vertex[v]];
            cell_nodes[local][v]           = node;
            cell_faces[local][opposite[v]] = face;
            node_key[node]                 = vertex.key;
            node_position[node]            = vertex.position;
            node_sides[node]               = vertex.walls;
            face_side[face]                = from.wall[opposite[v]];
            weight[v]                      = vertex.weight;
          }
        const Simplex<dim> x  = cell_vertices(local);
        cell_volume[local]    = signed_volume<dim>(x);
        cell_number[local]    = from.number;
        cell_size[local]      = from.size;
        cell_dual[local]      = weighted_circumcentre<dim>(x, weight);
        cell_gradients[local] = basis_gradients<dim>(x);
      }
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
          const LocalIndex f = cell_faces[c][i];
          if (face_cells[f][0] != invalid)
            {
              face_cells[f][1] = c;
              continue;
            }
          face_cells[f][0] = c;
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

    // a ghost's outer face: its owner knows which cell is the lower
    Vector lower = zeros(faces);
    for (LocalIndex f = 0; f < n_owned_faces(); ++f)
      lower.local_element(f) = cell_number[face_cells[f][0]];
    lower.update_ghost_values();
    for (LocalIndex f = 0; f < n; ++f)
      if (lower.local_element(f) != cell_number[face_cells[f][0]])
        {
          face_cells[f]  = {{invalid, face_cells[f][0]}};
          face_normal[f] = -face_normal[f];
        }
  }

  namespace
  {
    /// An imported mesh need not be Delaunay, and cells of one circumcircle have no
    /// dual length at all: no dual length is shorter than this part of the distance
    /// of the barycentres along the normal.
    constexpr double minimum_dual_length = 1e-2;
  } // namespace

  template <int dim>
  void
  Mesh<dim>::measure_dual_edges()
  {
    const auto barycentre = [&](const LocalIndex c) {
      Point<dim> x;
      for (const LocalIndex node : cell_nodes[c])
        x += node_position[node] / (dim + 1);
      return x;
    };
    Vector length = zeros(faces);
    for (LocalIndex f = 0; f < n_owned_faces(); ++f)
      {
        const auto           &[i, j] = face_cells[f];
        const Tensor<1, dim> &normal = face_normal[f];
        const Point<dim>     &o      = cell_dual[i];
        const Point<dim>      end =
          j == invalid ? Point<dim>(o + ((face_centre[f] - o) * normal) * normal) : cell_dual[j];
        double &l = length.local_element(f);
        l         = (end - o) * normal;
        if (on_lattice || j == invalid)
          continue;
        const double shortest =
          minimum_dual_length * ((barycentre(j) - barycentre(i)) * normal);
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
  void
  Mesh<dim>::make_tree()
  {
    const auto corners = [&](const LocalIndex c, std::vector<Point<dim>> &x) {
      for (const LocalIndex node : cell_nodes[c])
        x.push_back(node_position[node]);
    };
    std::vector<BoundingBox<dim>> boxes;
    std::vector<Point<dim>>       x;
    for (LocalIndex c = 0; c < cell_nodes.size(); ++c)
      {
        x.clear();
        corners(c, x);
        boxes.emplace_back(x);
      }
    std::vector<LocalIndex> order(n_owned_cells());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
      return cell_number[a] < cell_number[b];
    });
    std::vector<typename CellTree<dim>::WallFacet> walls;
    for (const LocalIndex c : order)
      for (const LocalIndex f : cell_faces[c])
        if (face_side[f] != no_side)
          {
            walls.push_back({{}, c});
            for (unsigned int k = 0; k < dim; ++k)
              walls.back().x[k] = node_position[face_nodes[f][k]];
          }
    const auto ranks = Utilities::MPI::all_gather(
      comm, treacle::covering_boxes<dim>(n_owned_cells(), corners));
    tree = std::make_unique<const CellTree<dim>>(boxes, walls, ranks);
    around = tree->box();
  }

  template <int dim>
  std::vector<BoundingBox<dim>>
  Mesh<dim>::covering_boxes() const
  {
    return on_lattice ? on_lattice->covering_boxes() :
                        tree->boxes_of_rank(Utilities::MPI::this_mpi_process(comm));
  }

  template class Mesh<2>;
  template class Mesh<3>;
} // namespace treacle
