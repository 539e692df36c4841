// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/viscosity_jump.h>
#include <treacle/surface/initial_jumps.h>

namespace treacle
{
  namespace
  {
    /// Nodes from the cells with a jump on, so that those within a leaf of it are reached.
    constexpr unsigned int n_layers_of_planes = 3;

    /// Where a property jumps in a cell.
    template <int dim>
    struct JumpPlane
    {
      using Numbers = std::array<double, 2 * dim + 2>;

      Numbers numbers; ///< centre of its part in the cell (m), unit normal to the upper side, lower and upper value

      JumpPlane() = default;

      JumpPlane(const Simplex<dim> &x, const std::array<Tensor<1, dim>, dim + 1> &gradients, const ViscosityJump<dim> &jump)
        : numbers{}
      {
        Point<dim>     sum;
        Tensor<1, dim> normal;
        unsigned int   n = 0;
        for (unsigned int i = 0; i <= dim; ++i)
          {
            normal += jump.distance[i] * gradients[i];
            for (unsigned int j = 0; j <= dim; ++j)
              if (const double below = jump.distance[i], above = jump.distance[j]; below <= 0 && above >= 0 && below < above)
                {
                  sum += x[i] + below / (below - above) * (x[j] - x[i]);
                  ++n;
                }
          }
        for (unsigned int d = 0; d < dim; ++d)
          {
            numbers[d]       = sum[d] / n;
            numbers[dim + d] = normal[d];
          }
        numbers[2 * dim]     = jump.viscosity[0];
        numbers[2 * dim + 1] = jump.viscosity[1];
      }

      Tensor<1, dim>
      from_centre(const Point<dim> &x) const
      {
        Tensor<1, dim> result = x;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] -= numbers[d];
        return result;
      }

      double
      distance(const Point<dim> &x) const
      {
        const Tensor<1, dim> way    = from_centre(x);
        double               result = 0;
        for (unsigned int d = 0; d < dim; ++d)
          result += numbers[dim + d] * way[d];
        return result;
      }

      /// From the lower value at -1 to the upper one at 1.
      double
      mean(const double place) const
      {
        const double lower = numbers[2 * dim], upper = numbers[2 * dim + 1];
        return lower + 0.5 * (1 + place) * (upper - lower);
      }

      /// Than another; the same on all ranks.
      bool
      is_nearer(const Point<dim> &x, const JumpPlane &other) const
      {
        const double here = from_centre(x).norm_square(), there = other.from_centre(x).norm_square();
        return std::tie(here, numbers) < std::tie(there, other.numbers);
      }
    };

    /// Of the planes in the cells, the nearest to each node.
    template <int dim>
    class NearestPlanes
    {
    public:
      explicit NearestPlanes(const Mesh<dim> &mesh)
        : mesh(mesh)
        , known(mesh.nodes)
        , numbers(std::tuple_size<typename JumpPlane<dim>::Numbers>::value, Vector(mesh.nodes))
      {}

      /// Tells an owned node of one.
      void
      offer(const LocalIndex node, const JumpPlane<dim> &plane)
      {
        if (is_known(node) && !plane.is_nearer(mesh.node_position[node], at(node)))
          return;
        for (unsigned int k = 0; k < numbers.size(); ++k)
          numbers[k].local_element(node) = plane.numbers[k];
        known.local_element(node) = 1;
      }

      /// To the nodes around those that know of one. Collective.
      void
      spread(const MeshData<dim> &data)
      {
        known.update_ghost_values();
        for (Vector &v : numbers)
          v.update_ghost_values();
        std::vector<std::pair<LocalIndex, JumpPlane<dim>>> offers;
        for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
          if (!is_known(node))
            for (const auto &neighbour : data.neighbours(node))
              if (is_known(neighbour.node))
                offers.emplace_back(node, at(neighbour.node));
        for (const auto &[node, plane] : offers)
          offer(node, plane);
      }

      bool
      is_known(const LocalIndex node) const
      {
        return known.local_element(node) > 0;
      }

      /// 1 at these, else 0; ghosts are not up to date.
      const Vector &
      known_nodes() const
      {
        return known;
      }

      JumpPlane<dim>
      at(const LocalIndex node) const
      {
        JumpPlane<dim> plane;
        for (unsigned int k = 0; k < numbers.size(); ++k)
          plane.numbers[k] = numbers[k].local_element(node);
        return plane;
      }

    private:
      const Mesh<dim>    &mesh;
      Vector              known;
      std::vector<Vector> numbers;
    };

    /// Where a property jumps in a cell at whose vertices it has these values, if it does: none may be NaN.
    template <int dim>
    std::optional<JumpPlane<dim>>
    plane_in_cell(const Mesh<dim>                                 &mesh,
                  const LocalIndex                                 c,
                  const MaterialProperty<dim>                     &property,
                  VertexValues<dim>                                values,
                  const std::function<double(const Point<dim> &)> &formula)
    {
      if (std::any_of(values.begin(), values.end(), [](const double value) { return std::isnan(value); }))
        return {};
      const auto [least, largest] = std::minmax_element(values.begin(), values.end());
      if (!property.jumps(*least, *largest))
        return {};
      // ratios tell sides apart, and there may be no viscosity on one
      const double shift = *least > 0 ? 0 : 1e-3 * *largest;
      for (double &value : values)
        value += shift;
      const Simplex<dim> x    = mesh.cell_vertices(c);
      auto               jump = find_jump<dim>(x, values, [&](const Point<dim> &at) { return formula(at) + shift; });
      if (!jump)
        return {};
      for (double &value : jump->viscosity)
        value -= shift;
      return JumpPlane<dim>(x, mesh.cell_gradients[c], *jump);
    }

    /// The smallest leaf about a node: all nodes of a cell with a plane are to have the same where there are larger ones behind them.
    template <int dim>
    double
    leaf_about(const Mesh<dim> &mesh, const LocalIndex node)
    {
      double size = std::numeric_limits<double>::max();
      for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
        size = std::min(size, mesh.cell_size[mesh.node_cells[k]]);
      return size;
    }
  } // namespace

  template <int dim>
  Vector
  set_means_about_jumps(const MeshData<dim>                             &data,
                        const MaterialProperty<dim>                     &property,
                        const std::vector<double>                       &at_nodes,
                        const std::function<double(const Point<dim> &)> &formula)
  {
    const Mesh<dim>   &mesh = data.mesh;
    NearestPlanes<dim> planes(mesh);
    for (LocalIndex c = 0; c < mesh.cell_nodes.size(); ++c)
      if (const auto plane = plane_in_cell(mesh, c, property, mesh.values(c, at_nodes), formula))
        for (const LocalIndex node : mesh.cell_nodes[c])
          if (node < mesh.n_owned_nodes())
            planes.offer(node, *plane);
    for (unsigned int layer = 0; layer < n_layers_of_planes; ++layer)
      planes.spread(data);
    for (LocalIndex node = 0; node < mesh.n_owned_nodes(); ++node)
      if (planes.is_known(node))
        {
          const JumpPlane<dim> plane = planes.at(node);
          const double         leaf  = leaf_about(mesh, node);
          const double distance = std::min(std::max(plane.distance(mesh.node_position[node]), -leaf), leaf);
          property.field.mean.local_element(node) = plane.mean(distance / leaf);
        }
    return planes.known_nodes();
  }

  template Vector
  set_means_about_jumps(const MeshData<2> &,
                        const MaterialProperty<2> &,
                        const std::vector<double> &,
                        const std::function<double(const Point<2> &)> &);
  template Vector
  set_means_about_jumps(const MeshData<3> &,
                        const MaterialProperty<3> &,
                        const std::vector<double> &,
                        const std::function<double(const Point<3> &)> &);
} // namespace treacle
