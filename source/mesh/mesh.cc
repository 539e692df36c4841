// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/mesh.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <numeric>
#include <set>
#include <unordered_set>

namespace treacle
{
  namespace
  {
    /// Bit 2 axis + upper is set where p lies on that side of the box.
    template <int dim>
    unsigned int
    box_sides(const Octree<dim> &octree, const LatticePoint<dim> &p)
    {
      unsigned int sides = 0;
      for (unsigned int d = 0; d < dim; ++d)
        sides |= (p[d] == 0) << (2 * d) | (p[d] == octree.extent()[d]) << (2 * d + 1);
      return sides;
    }

    unsigned int
    first_side(const unsigned int sides)
    {
      unsigned int side = 0;
      while ((sides >> side & 1) == 0)
        ++side;
      return side;
    }
  } // namespace

  /// A cell as ranks exchange it.
  template <int dim>
  struct Mesh<dim>::CellRecord
  {
    GlobalIndex                    id;
    unsigned int                   owner;
    unsigned int                   face; ///< of the leaf it stands on
    VertexKey                      leaf; ///< its origin
    double                         size;
    std::array<VertexKey, dim + 1> vertex;
    VertexValues<dim>              weight;
  };

  template <int dim>
  Mesh<dim>::Mesh(std::shared_ptr<const Octree<dim>> octree)
    : triangulation(octree->communicator())
    , tree(std::move(octree))
  {
    std::vector<CellRecord> records = make_cells();
    exchange_ghosts(records);
    create_triangulation(records);
    number(records);
    fill_cells(records);
    fill_faces();
    fill_nodes();
  }

  template <int dim>
  std::vector<typename Mesh<dim>::CellRecord>
  Mesh<dim>::make_cells()
  {
    Lattice<dim>      lattice = make_lattice(*tree);
    const GlobalIndex n_owned = lattice.cells.size();
    GlobalIndex       first   = 0;
    MPI_Exscan(&n_owned, &first, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, communicator());
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator());

    std::unordered_map<VertexKey, double> weight;
    weight.reserve(lattice.cells.size() / 2);
    std::vector<CellRecord> records(n_owned);
    for (unsigned int group = 0; group + 1 < lattice.start.size(); ++group)
      for (unsigned int i = lattice.start[group]; i < lattice.start[group + 1]; ++i)
        {
          const Leaf<dim> &leaf   = tree->leaves()[group / (2 * dim)];
          CellRecord      &record = records[i];
          record.id               = first + i;
          record.owner            = rank;
          record.leaf             = pack<dim>(leaf.origin);
          record.face             = group % (2 * dim);
          record.size             = tree->size(leaf);
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const LatticePoint<dim> &p = lattice.cells[i][v];
              record.vertex[v]           = pack<dim>(p);
              const auto [it, is_new] = weight.emplace(record.vertex[v], 0.);
              if (is_new)
                it->second = lattice_weight<dim>(*tree, p);
              record.weight[v] = it->second;
            }
        }
    start = std::move(lattice.start);
    return records;
  }

  namespace
  {
    /// The 3^dim corners, midpoints and centre of a leaf. Two leaves touch
    /// where these meet, for sizes differ by at most two.
    template <int dim>
    std::vector<VertexKey>
    lattice_points(const Leaf<dim> &leaf)
    {
      std::vector<VertexKey> keys;
      for (unsigned int k = 0; k < (dim == 2 ? 9u : 27u); ++k)
        {
          LatticePoint<dim> p    = leaf.origin;
          unsigned int      code = k;
          for (unsigned int d = 0; d < dim; ++d, code /= 3)
            p[d] += (code % 3) * leaf.size / 2;
          keys.push_back(pack<dim>(p));
        }
      return keys;
    }

    /// Does each owned leaf touch a leaf of another rank?
    template <int dim>
    std::vector<bool>
    leaves_at_border(const Octree<dim> &octree)
    {
      std::unordered_set<VertexKey> beyond;
      for (unsigned int l = octree.n_owned_leaves(); l < octree.leaves().size(); ++l)
        for (const VertexKey key : lattice_points(octree.leaves()[l]))
          beyond.insert(key);
      std::vector<bool> result(octree.n_owned_leaves(), false);
      for (unsigned int l = 0; l < result.size(); ++l)
        for (const VertexKey key : lattice_points(octree.leaves()[l]))
          result[l] = result[l] || beyond.count(key) > 0;
      return result;
    }

    /// The other ranks that named the same keys. Collective.
    std::unordered_map<VertexKey, std::vector<unsigned int>>
    sharing_ranks(const MPI_Comm &comm, const std::unordered_set<VertexKey> &keys)
    {
      struct Pair
      {
        VertexKey    key;
        unsigned int rank;
      };
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
      PerRank<VertexKey> named(n_ranks);
      for (const VertexKey key : keys)
        named[meeting_rank(key, n_ranks)].push_back(key);
      const PerRank<VertexKey> heard = send_and_receive(comm, named);

      std::unordered_map<VertexKey, std::vector<unsigned int>> who;
      for (unsigned int r = 0; r < n_ranks; ++r)
        for (const VertexKey key : heard[r])
          who[key].push_back(r);
      PerRank<Pair> answer(n_ranks);
      for (const auto &[key, ranks] : who)
        for (const unsigned int r : ranks)
          for (const unsigned int other : ranks)
            if (other != r)
              answer[r].push_back({key, other});

      std::unordered_map<VertexKey, std::vector<unsigned int>> result;
      for (const auto &pairs : send_and_receive(comm, answer))
        for (const Pair &pair : pairs)
          result[pair.key].push_back(pair.rank);
      return result;
    }
  } // namespace

  template <int dim>
  void
  Mesh<dim>::exchange_ghosts(std::vector<CellRecord> &records) const
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator());
    if (n_ranks == 1)
      return;

    // only vertices of the cells of leaves at the border can be another's too
    const std::vector<bool>       at_border = leaves_at_border(*tree);
    std::unordered_set<VertexKey> candidates;
    for (unsigned int l = 0; l < at_border.size(); ++l)
      if (at_border[l])
        for (unsigned int i = start[2 * dim * l]; i < start[2 * dim * (l + 1)]; ++i)
          candidates.insert(records[i].vertex.begin(), records[i].vertex.end());

    const auto          sharers = sharing_ranks(communicator(), candidates);
    PerRank<CellRecord> to_rank(n_ranks);
    for (const CellRecord &record : records)
      {
        std::set<unsigned int> ranks;
        for (const VertexKey key : record.vertex)
          if (const auto it = sharers.find(key); it != sharers.end())
            ranks.insert(it->second.begin(), it->second.end());
        for (const unsigned int r : ranks)
          to_rank[r].push_back(record);
      }
    for (const auto &received : send_and_receive(communicator(), to_rank))
      records.insert(records.end(), received.begin(), received.end());
    std::sort(records.begin(), records.end(), [](const auto &a, const auto &b) {
      return a.id < b.id;
    });
  }

  template <int dim>
  void
  Mesh<dim>::create_triangulation(const std::vector<CellRecord> &records)
  {
    TriangulationDescription::Description<dim, dim> description;
    description.comm      = communicator();
    description.settings  = TriangulationDescription::Settings::default_setting;
    description.smoothing = Triangulation<dim>::none;
    description.cell_infos.resize(1);
    description.coarse_cells.resize(records.size());
    description.cell_infos[0].resize(records.size());

    std::unordered_map<VertexKey, unsigned int> vertex_index;
    vertex_index.reserve(records.size() / 2);
    const auto reference = ReferenceCells::get_simplex<dim>();
    for (unsigned int i = 0; i < records.size(); ++i)
      {
        auto &cell = description.coarse_cells[i];
        cell.vertices.resize(dim + 1);
        std::array<unsigned int, dim + 1> sides;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const VertexKey key = records[i].vertex[v];
            const auto [it, is_new] =
              vertex_index.emplace(key, description.coarse_cell_vertices.size());
            if (is_new)
              description.coarse_cell_vertices.push_back(
                tree->position(unpack<dim>(key)));
            cell.vertices[v] = it->second;
            sides[v]         = box_sides<dim>(*tree, unpack<dim>(key));
          }
        description.coarse_cell_index_to_coarse_cell_id.push_back(records[i].id);

        auto &info              = description.cell_infos[0][i];
        info.id                 = CellId(records[i].id, {}).template to_binary<dim>();
        info.subdomain_id       = records[i].owner;
        info.level_subdomain_id = records[i].owner;
        info.manifold_id        = numbers::flat_manifold_id;
        info.manifold_line_ids.fill(numbers::flat_manifold_id);
        info.manifold_quad_ids.fill(numbers::flat_manifold_id);
        for (unsigned int f = 0; f <= dim; ++f)
          {
            unsigned int on = ~0u;
            for (unsigned int v = 0; v < dim; ++v)
              on &= sides[reference.face_to_cell_vertices(f, v, 1)];
            if (on != 0)
              info.boundary_ids.emplace_back(f, first_side(on));
          }
      }
    triangulation.create_triangulation(description);
  }

  template <int dim>
  void
  Mesh<dim>::number(const std::vector<CellRecord> &records)
  {
    node_dofs.reinit(triangulation);
    node_dofs.distribute_dofs(FE_SimplexP<dim>(1));
    face_dofs.reinit(triangulation);
    face_dofs.distribute_dofs(FaceNormalElement<dim>());

    const auto make = [&](const DoFHandler<dim> &dofs) {
      IndexSet relevant;
      DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      return std::make_shared<const Utilities::MPI::Partitioner>(
        dofs.locally_owned_dofs(), relevant, communicator());
    };
    nodes = make(node_dofs);
    faces = make(face_dofs);

    const GlobalIndex n_owned = start.back();
    GlobalIndex       first = 0, n_cells = 0;
    MPI_Exscan(&n_owned, &first, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, communicator());
    n_cells = Utilities::MPI::sum(n_owned, communicator());
    IndexSet owned(n_cells), ghosts(n_cells);
    owned.add_range(first, first + n_owned);
    std::vector<GlobalIndex> ids;
    for (const CellRecord &record : records)
      if (!owned.is_element(record.id))
        ids.push_back(record.id);
    ghosts.add_indices(ids.begin(), ids.end());
    cells = std::make_shared<const Utilities::MPI::Partitioner>(owned, ghosts, communicator());
  }

  template <int dim>
  void
  Mesh<dim>::fill_cells(const std::vector<CellRecord> &records)
  {
    const unsigned int n = records.size();
    cell_nodes.resize(n);
    cell_faces.resize(n);
    cell_volume.resize(n);
    cell_size.resize(n);
    cell_dual.resize(n);
    cell_gradients.resize(n);
    const unsigned int n_nodes = nodes->locally_owned_size() + nodes->n_ghost_indices();
    node_position.resize(n_nodes);
    node_key.resize(n_nodes);
    node_sides.resize(n_nodes);

    std::unordered_map<GlobalIndex, unsigned int> record_of;
    record_of.reserve(n);
    for (unsigned int i = 0; i < n; ++i)
      record_of[records[i].id] = i;

    std::array<unsigned int, dim + 1> opposite; // vertex of deal.II's face f
    const auto reference = ReferenceCells::get_simplex<dim>();
    for (unsigned int f = 0; f <= dim; ++f)
      {
        opposite[f] = dim * (dim + 1) / 2;
        for (unsigned int v = 0; v < dim; ++v)
          opposite[f] -= reference.face_to_cell_vertices(f, v, 1);
      }

    std::vector<GlobalIndex> node_ids(dim + 1), face_ids(dim + 1);
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const GlobalIndex  id    = cell->id().get_coarse_cell_id();
        const LocalIndex   local = cells->global_to_local(id);
        const CellRecord  &r     = records[record_of.at(id)];
        typename DoFHandler<dim>::active_cell_iterator(*cell, &node_dofs)->get_dof_indices(node_ids);
        typename DoFHandler<dim>::active_cell_iterator(*cell, &face_dofs)->get_dof_indices(face_ids);
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const LocalIndex node    = nodes->global_to_local(node_ids[v]);
            cell_nodes[local][v]     = node;
            node_key[node]           = r.vertex[v];
            const LatticePoint<dim> p = unpack<dim>(r.vertex[v]);
            node_position[node]      = tree->position(p);
            node_sides[node]         = box_sides<dim>(*tree, p);
            cell_faces[local][opposite[v]] = faces->global_to_local(face_ids[v]);
          }
        const Simplex<dim> x  = cell_vertices(local);
        cell_volume[local]    = signed_volume<dim>(x);
        cell_size[local]      = r.size;
        cell_dual[local]      = weighted_circumcentre<dim>(x, r.weight);
        cell_gradients[local] = basis_gradients<dim>(x);
        if (!cell->is_locally_owned())
          ghosts_over[{r.leaf, r.face}].push_back(local);
      }
    for (auto &[leaf_face, list] : ghosts_over)
      std::sort(list.begin(), list.end());
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
    face_dual_length.resize(n);
    face_side.assign(n, no_side);

    // cells in the order of their global index: the lower comes first
    std::vector<LocalIndex> order(cell_nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
      return cells->local_to_global(a) < cells->local_to_global(b);
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
          unsigned int                sides = ~0u;
          Point<dim>                  centre;
          for (unsigned int k = 0, v = 0; v <= dim; ++v)
            if (v != i)
              {
                face_nodes[f][k] = cell_nodes[c][v];
                x[k]             = node_position[cell_nodes[c][v]];
                sides &= node_sides[cell_nodes[c][v]];
                centre += x[k++] / dim;
              }
          Tensor<1, dim> a = area_vector<dim>(x);
          if (a * (x[0] - node_position[cell_nodes[c][i]]) < 0)
            a = -a;
          face_area[f]   = a.norm();
          face_normal[f] = a / face_area[f];
          face_centre[f] = centre;
          if (sides != 0)
            face_side[f] = first_side(sides);
        }

    // a ghost's outer face: its owner knows which cell is the lower
    Vector lower = zeros(faces), length = zeros(faces);
    for (LocalIndex f = 0; f < n_owned_faces(); ++f)
      {
        const Point<dim> &o   = cell_dual[face_cells[f][0]];
        const Point<dim>  end = face_cells[f][1] == invalid ?
                                  Point<dim>(o + ((face_centre[f] - o) * face_normal[f]) * face_normal[f]) :
                                  cell_dual[face_cells[f][1]];
        lower.local_element(f)  = cells->local_to_global(face_cells[f][0]);
        length.local_element(f) = (end - o) * face_normal[f];
      }
    lower.update_ghost_values();
    length.update_ghost_values();
    for (LocalIndex f = 0; f < n; ++f)
      {
        face_dual_length[f] = length.local_element(f);
        if (lower.local_element(f) != cells->local_to_global(face_cells[f][0]))
          {
            face_cells[f]  = {{invalid, face_cells[f][0]}};
            face_normal[f] = -face_normal[f];
          }
      }
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
  Mesh<dim>::cells_over(const Leaf<dim>         &leaf,
                        const unsigned int       face,
                        std::vector<LocalIndex> &result) const
  {
    result.clear();
    const LocalIndex l = tree->leaf_at(leaf.origin);
    if (l != invalid && l < tree->n_owned_leaves())
      for (unsigned int i = start[2 * dim * l + face]; i < start[2 * dim * l + face + 1]; ++i)
        result.push_back(i);
    else if (const auto it = ghosts_over.find({pack<dim>(leaf.origin), face}); it != ghosts_over.end())
      result = it->second;
  }

  template class Mesh<2>;
  template class Mesh<3>;
} // namespace treacle
