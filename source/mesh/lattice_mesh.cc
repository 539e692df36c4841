// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/geometry/simplex.h>
#include <treacle/mesh/covering_boxes.h>
#include <treacle/mesh/ghost_cells.h>
#include <treacle/mesh/lattice.h>
#include <treacle/mesh/lattice_mesh.h>
#include <treacle/mesh/lattice_weight.h>

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
  } // namespace

  /// A cell as ranks exchange it.
  template <int dim>
  struct LatticeMesh<dim>::Record
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
  LatticeMesh<dim>::LatticeMesh(std::shared_ptr<const Octree<dim>> octree)
    : tree(std::move(octree))
  {
    std::vector<Record> records = make_records();
    if (Utilities::MPI::n_mpi_processes(tree->communicator()) > 1)
      {
        // only vertices of the cells of leaves at the border can be another's too
        const std::vector<bool>       at_border = leaves_at_border(*tree);
        std::unordered_set<VertexKey> candidates;
        for (unsigned int l = 0; l < at_border.size(); ++l)
          if (at_border[l])
            for (unsigned int i = start[2 * dim * l]; i < start[2 * dim * (l + 1)]; ++i)
              candidates.insert(records[i].vertex.begin(), records[i].vertex.end());
        exchange_ghosts(tree->communicator(), candidates, records);
      }
    take(records);
  }

  template <int dim>
  std::vector<typename LatticeMesh<dim>::Record>
  LatticeMesh<dim>::make_records()
  {
    Lattice<dim>      lattice = make_lattice(*tree);
    const MPI_Comm   &comm    = tree->communicator();
    const GlobalIndex n_owned = lattice.cells.size();
    const GlobalIndex first   = sum_of_lower_ranks(comm, n_owned);
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);

    std::unordered_map<VertexKey, double> weight;
    weight.reserve(lattice.cells.size() / 2);
    std::vector<Record> records(n_owned);
    for (unsigned int group = 0; group + 1 < lattice.start.size(); ++group)
      for (unsigned int i = lattice.start[group]; i < lattice.start[group + 1]; ++i)
        {
          const Leaf<dim> &leaf   = tree->leaves()[group / (2 * dim)];
          Record          &record = records[i];
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

  template <int dim>
  void
  LatticeMesh<dim>::take(const std::vector<Record> &records)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(tree->communicator());
    std::unordered_map<VertexKey, unsigned int> vertex_index;
    vertex_index.reserve(records.size() / 2);
    cells.cells.reserve(records.size());
    LocalIndex next_ghost = start.back();
    for (const Record &record : records)
      {
        typename MeshCells<dim>::Cell cell{
          record.id, record.id, record.owner, record.size, {}, {}};
        for (unsigned int v = 0; v <= dim; ++v)
          {
            const auto [it, is_new] =
              vertex_index.emplace(record.vertex[v], cells.vertices.size());
            if (is_new)
              {
                const LatticePoint<dim> p = unpack<dim>(record.vertex[v]);
                cells.vertices.push_back({record.vertex[v],
                                          tree->position(p),
                                          record.weight[v],
                                          static_cast<unsigned short>(box_sides<dim>(*tree, p))});
              }
            cell.vertex[v] = it->second;
          }
        for (unsigned int v = 0; v <= dim; ++v)
          {
            unsigned int on = ~0u;
            for (unsigned int w = 0; w <= dim; ++w)
              if (w != v)
                on &= cells.vertices[cell.vertex[w]].walls;
            cell.wall[v] = on != 0 ? first_side(on) : Walls<dim>::none;
          }
        cells.cells.push_back(cell);
        if (record.owner != rank)
          ghosts_over[{record.leaf, record.face}].push_back(next_ghost++);
      }
  }

  template <int dim>
  void
  LatticeMesh<dim>::cells_over(const Leaf<dim>         &leaf,
                               const unsigned int       face,
                               std::vector<LocalIndex> &result) const
  {
    const LocalIndex l = tree->leaf_at(leaf.origin);
    if (l != invalid && l < tree->n_owned_leaves())
      return cells_over(l, face, result);
    result.clear();
    if (const auto it = ghosts_over.find({pack<dim>(leaf.origin), face}); it != ghosts_over.end())
      result = it->second;
  }

  template <int dim>
  void
  LatticeMesh<dim>::cells_over(const LocalIndex l, const unsigned int face, std::vector<LocalIndex> &result) const
  {
    result.clear();
    for (unsigned int i = start[2 * dim * l + face]; i < start[2 * dim * l + face + 1]; ++i)
      result.push_back(i);
  }

  namespace
  {
    /// Ends of runs of owned leaves, each within a cube of its own: a run of so many along the curve
    /// may lie in two far corners of a box.
    template <int dim>
    class CompactRuns
    {
    public:
      explicit CompactRuns(const Octree<dim> &octree)
        : octree(octree)
        , longest(octree.n_owned_leaves() / 256 + 1)
      {
        divide(0, octree.n_owned_leaves(), 2 * octree.root_size());
      }

      std::vector<unsigned int> ends;

    private:
      /// Leaves from begin to end, in cubes half as large as they share.
      void
      divide(unsigned int begin, const unsigned int end, const int size)
      {
        const auto cube = [&](const unsigned int l) {
          return cube_around<dim>(octree.leaves()[l].origin, size / 2);
        };
        while (begin < end)
          {
            unsigned int next = begin + 1;
            while (next < end && cube(next) == cube(begin))
              ++next;
            if (next - begin > longest)
              divide(begin, next, size / 2);
            else
              ends.push_back(next);
            begin = next;
          }
      }

      const Octree<dim> &octree;
      const unsigned int longest; ///< run
    };
  } // namespace

  template <int dim>
  std::vector<BoundingBox<dim>>
  LatticeMesh<dim>::covering_boxes() const
  {
    return treacle::covering_boxes<dim>(
      CompactRuns<dim>(*tree).ends, [&](const unsigned int l, std::vector<Point<dim>> &corners) {
        const Leaf<dim>  &leaf = tree->leaves()[l];
        LatticePoint<dim> top  = leaf.origin;
        for (int &i : top)
          i += leaf.size;
        // cells reach to the centre of a leaf beside
        Tensor<1, dim> beyond;
        for (unsigned int d = 0; d < dim; ++d)
          beyond[d] = 0.5 * tree->size(leaf);
        corners.push_back(tree->position(leaf.origin) - beyond);
        corners.push_back(tree->position(top) + beyond);
      });
  }

  template class LatticeMesh<2>;
  template class LatticeMesh<3>;
} // namespace treacle
