// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_cut_cells_h
#define treacle_fields_cut_cells_h

#include <treacle/geometry/cut_simplex.h>
#include <treacle/mesh/mesh.h>
#include <treacle/scene/scene.h>

#include <deal.II/base/array_view.h>

namespace treacle
{
  /// The open parts of the cells that solids cut, each as up to three simplices between
  /// nodes outside the solid and points of its wall, where the velocity is the solid's.
  /// On faces the simplices of two cells meet, so that P1 functions on them are continuous.
  template <int dim>
  class CutCells
  {
  public:
    static constexpr unsigned char on_wall = dim + 1;

    struct Part
    {
      double                                  fraction; ///< of the open part's volume
      std::array<Tensor<1, dim>, dim + 1>     gradient; ///< of the P1 functions (1/m)
      std::array<unsigned char, dim + 1>      vertex;   ///< of the cell; on_wall
      std::array<Tensor<1, dim>, dim + 1>     velocity; ///< of points of the wall (m/s)

      /// Of the node velocity v and that of the wall; @p nodes are the cell's.
      template <typename Nodes>
      Tensor<2, dim>
      velocity_gradient(const Nodes &nodes, const NodeVector<dim> &v) const
      {
        Tensor<2, dim> result;
        for (unsigned int k = 0; k <= dim; ++k)
          result += outer_product(vertex[k] == on_wall ? velocity[k] : v.value(nodes[vertex[k]]), gradient[k]);
        return result;
      }
    };

    /// No cell is cut.
    CutCells() = default;

    /// @p solid_distance at the nodes is positive outside solids (m).
    CutCells(const Mesh<dim>           &mesh,
             const Scene<dim>          &scene,
             const std::vector<double> &solid_distance,
             const double               time);

    /// Of a cell; none where it is not cut.
    ArrayView<const Part>
    parts(const LocalIndex cell) const
    {
      if (start.empty())
        return {};
      return ArrayView<const Part>(all.data() + start[cell], start[cell + 1] - start[cell]);
    }

    /// From now on no cell is cut for which @p is_whole holds.
    template <typename Predicate>
    void
    close(const Predicate &is_whole)
    {
      std::vector<Part> kept;
      for (LocalIndex c = 0; c + 1 < start.size(); ++c)
        {
          const auto of_cell = parts(c);
          start[c]           = kept.size();
          if (of_cell.size() > 0 && !is_whole(c))
            kept.insert(kept.end(), of_cell.begin(), of_cell.end());
        }
      if (!start.empty())
        start.back() = kept.size();
      all = std::move(kept);
    }

    /// The volume outside solids (m^dim) of a cell that is cut.
    double
    open_volume(const LocalIndex cell) const
    {
      return volume[cell];
    }

  private:
    /// The open parts of a cell with these vertices and -solid distances there, as volumes in
    /// the place of fractions.
    void
    append_parts(const Simplex<dim>      &x,
                 const VertexValues<dim> &psi,
                 const double             least_volume,
                 const Scene<dim>        &scene,
                 const double             time);

    std::vector<unsigned int> start; ///< of each cell in all, and the end
    std::vector<Part>         all;
    std::vector<double>       volume;
  };
} // namespace treacle

#endif
