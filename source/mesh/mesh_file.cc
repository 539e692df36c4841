// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/geometry/nearest_point.h>
#include <treacle/geometry/simplex.h>
#include <treacle/mesh/mesh_file.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/rtree.h>

#include <fstream>
#include <map>
#include <sstream>

namespace treacle
{
  namespace
  {
    template <int dim>
    const char *
    shape_name()
    {
      return dim == 2 ? "triangles" : "tetrahedra";
    }

    template <int dim>
    void
    read_file(const std::string &path, Triangulation<dim> &triangulation)
    {
      require(!path.empty(), "Mesh/File: the type \"file\" needs the name of a mesh file.");
      require(std::ifstream(path).good(),
              "Mesh/File: the file \"" + path + "\" cannot be opened.");
      const std::string in_short = "Mesh/File: no mesh of " + std::string(shape_name<dim>()) +
                                   " can be read from \"" + path +
                                   "\"; in Gmsh, save the mesh as .msh, version 2.2 or 4.1, ASCII";
      try
        {
          GridIn<dim>(triangulation).read(path);
        }
      catch (const ExceptionBase &exception)
        {
          std::ostringstream text;
          exception.print_info(text);
          std::istringstream words(text.str());
          std::string        reason;
          for (std::string word; words >> word && reason.size() < 200;)
            reason += " " + word;
          throw UserError(in_short +
                          (reason == " (none)" ? "." : " (deal.II says:" + reason + ")."));
        }
      catch (const std::exception &exception)
        {
          throw UserError(in_short + " (" + exception.what() + ").");
        }
      for (const ReferenceCell &kind : triangulation.get_reference_cells())
        require(kind == ReferenceCells::get_simplex<dim>(),
                "Mesh/File: the mesh \"" + path + "\" has cells of the kind " +
                  kind.to_string() + "; it must be made of " + shape_name<dim>() + " alone.");
    }
  } // namespace

  template <int dim>
  MeshFile<dim>::MeshFile(const std::string &path, const unsigned int n_ranks)
    : path(path)
  {
    Triangulation<dim> triangulation;
    read_file(path, triangulation);
    vertices = triangulation.get_vertices();
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        cells.emplace_back();
        for (unsigned int v = 0; v <= dim; ++v)
          cells.back()[v] = cell->vertex_index(v);
      }
    part(triangulation, n_ranks);
    orient_cells();
    find_neighbours();
    find_walls();
    check_walls();
    check_connected();
  }

  template <int dim>
  void
  MeshFile<dim>::part(Triangulation<dim> &triangulation, const unsigned int n_ranks)
  {
    require(cells.size() >= n_ranks,
            "Mesh/File: the mesh \"" + path + "\" has " + std::to_string(cells.size()) +
              " cells, fewer than there are ranks; start fewer.");
    rank_of.assign(cells.size(), 0);
    if (n_ranks == 1)
      return;
    GridTools::partition_triangulation(n_ranks, triangulation, SparsityTools::Partitioner::metis);
    std::vector<unsigned int> n_cells(n_ranks, 0);
    unsigned int              i = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      ++n_cells[rank_of[i++] = cell->subdomain_id()];
    if (*std::min_element(n_cells.begin(), n_cells.end()) == 0) // very few cells
      for (i = 0; i < cells.size(); ++i)
        rank_of[i] = static_cast<std::uint64_t>(i) * n_ranks / cells.size();
  }

  template <int dim>
  void
  MeshFile<dim>::fail(const std::string &problem, const Point<dim> &x) const
  {
    throw UserError("Mesh/File: in the mesh \"" + path + "\" " + problem + " at (" + to_text(x, 6) + ").");
  }

  template <int dim>
  std::array<unsigned int, dim>
  MeshFile<dim>::facet(const unsigned int cell, const unsigned int v) const
  {
    std::array<unsigned int, dim> result;
    for (unsigned int k = 0, w = 0; w <= dim; ++w)
      if (w != v)
        result[k++] = cells[cell][w];
    return result;
  }

  template <int dim>
  std::array<Point<dim>, dim>
  MeshFile<dim>::positions(const std::array<unsigned int, dim> &facet) const
  {
    std::array<Point<dim>, dim> x;
    for (unsigned int k = 0; k < dim; ++k)
      x[k] = vertices[facet[k]];
    return x;
  }

  template <int dim>
  void
  MeshFile<dim>::orient_cells()
  {
    for (auto &cell : cells)
      {
        Simplex<dim> x;
        double       size = 0;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            x[v] = vertices[cell[v]];
            size = std::max(size, x[v].distance(x[0]));
          }
        const double volume = signed_volume<dim>(x);
        if (std::abs(volume) <= 1e-10 * std::pow(size, dim))
          fail("a cell has no volume", x[0]);
        if (volume < 0)
          std::swap(cell[dim - 1], cell[dim]);
      }
  }

  template <int dim>
  void
  MeshFile<dim>::find_neighbours()
  {
    neighbours.resize(cells.size());
    for (auto &list : neighbours)
      list.fill(invalid);
    struct Place
    {
      unsigned int cell, vertex;
      bool         is_full;
    };
    std::map<std::array<unsigned int, dim>, Place> first;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int v = 0; v <= dim; ++v)
        {
          std::array<unsigned int, dim> key = facet(c, v);
          std::sort(key.begin(), key.end());
          const auto [it, is_new] = first.emplace(key, Place{c, v, false});
          if (is_new)
            continue;
          Place                            &other = it->second;
          const std::array<Point<dim>, dim> x     = positions(key);
          if (other.is_full)
            fail("more than two cells share a face", x[0]);
          const Tensor<1, dim> a = area_vector<dim>(x);
          if ((vertices[cells[c][v]] - x[0]) * a *
                ((vertices[cells[other.cell][other.vertex]] - x[0]) * a) >
              0)
            fail("two cells overlap", x[0]);
          other.is_full                           = true;
          neighbours[c][v]                        = other.cell;
          neighbours[other.cell][other.vertex]    = c;
        }
  }

  template <int dim>
  void
  MeshFile<dim>::check_connected() const
  {
    std::vector<unsigned char> is_reached(cells.size(), 0);
    std::vector<unsigned int>  stack(1, 0);
    is_reached[0] = 1;
    while (!stack.empty())
      {
        const unsigned int c = stack.back();
        stack.pop_back();
        for (const unsigned int other : neighbours[c])
          if (other != invalid && !is_reached[other])
            {
              is_reached[other] = 1;
              stack.push_back(other);
            }
      }
    const auto it = std::find(is_reached.begin(), is_reached.end(), 0);
    if (it != is_reached.end())
      fail("there are pieces that share no face with the rest, as",
           vertices[cells[it - is_reached.begin()][0]]);
  }

  template <int dim>
  void
  MeshFile<dim>::find_walls()
  {
    const BoundingBox<dim> box(vertices);
    const double           tolerance = 1e-8 * box.side_length(0);
    vertex_walls.assign(vertices.size(), 0);
    walls.resize(cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int v = 0; v <= dim; ++v)
        {
          walls[c][v] = Walls<dim>::none;
          if (neighbours[c][v] != invalid)
            continue;
          walls[c][v]                           = Walls<dim>::oblique;
          const std::array<unsigned int, dim> f = facet(c, v);
          const std::array<Point<dim>, dim>   x = positions(f);
          const Tensor<1, dim>                a = area_vector<dim>(x);
          for (unsigned int d = 0; d < dim; ++d)
            if (std::abs(a[d]) > (1 - 1e-12) * a.norm())
              walls[c][v] = std::abs(x[0][d] - box.lower_bound(d)) < tolerance ? 2 * d :
                            std::abs(x[0][d] - box.upper_bound(d)) < tolerance ?
                                                                               2 * d + 1 :
                                                                               Walls<dim>::inner + d;
          for (const unsigned int vertex : f)
            vertex_walls[vertex] |= 1u << walls[c][v];
        }
  }

  template <int dim>
  void
  MeshFile<dim>::check_walls() const
  {
    // where the mesh does not conform there is a vertex on a wall that is not its own
    std::vector<std::array<unsigned int, dim>>             facets;
    std::vector<std::pair<BoundingBox<dim>, unsigned int>> boxes;
    const double tolerance = 1e-10 * BoundingBox<dim>(vertices).side_length(0);
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int v = 0; v <= dim; ++v)
        if (neighbours[c][v] == invalid)
          {
            facets.push_back(facet(c, v));
            const std::array<Point<dim>, dim> x = positions(facets.back());
            boxes.emplace_back(BoundingBox<dim>(std::vector<Point<dim>>(x.begin(), x.end())),
                               boxes.size());
            boxes.back().first.extend(tolerance);
          }
    const auto tree = pack_rtree(boxes);
    for (unsigned int i = 0; i < vertices.size(); ++i)
      if (vertex_walls[i] != 0)
        for (const auto &[box, k] :
             tree | boost::geometry::index::adaptors::queried(
                      boost::geometry::index::intersects(vertices[i])))
          if (std::find(facets[k].begin(), facets[k].end(), i) == facets[k].end() &&
              vertices[i].distance(nearest_point(positions(facets[k]), vertices[i])) < tolerance)
            fail("a vertex lies on a face that it is no vertex of (a hanging node, or vertices "
                 "that are there twice: in Gmsh, use Coherence)",
                 vertices[i]);
  }

  template struct MeshFile<2>;
  template struct MeshFile<3>;
} // namespace treacle
