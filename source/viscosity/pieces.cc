// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/connected_liquid.h>
#include <treacle/fields/flood.h>
#include <treacle/viscosity/pieces.h>

#include <limits>

namespace treacle
{
  namespace
  {
    /// Of each numbered node the smallest number among those that active cells connect it with, ghosts among them; others have -1.
    template <int dim>
    Vector
    label_connected_nodes(const LiquidDomain<dim> &domain, const Numbering &numbering)
    {
      const Mesh<dim> &mesh  = domain.mesh;
      Vector           label = mesh.zeros(mesh.nodes);
      label.add(-1);
      for (const LocalIndex node : numbering.owned)
        label.local_element(node) = numbering.number[node];
      const auto in_active_cells = [&](const LocalIndex node, const auto &visit) {
        for (unsigned int k = mesh.node_cell_start[node]; k < mesh.node_cell_start[node + 1]; ++k)
          if (domain.is_active_cell[mesh.node_cells[k]])
            for (const LocalIndex other : mesh.cell_nodes[mesh.node_cells[k]])
              visit(other);
      };
      Flood(label, in_active_cells).run();
      return label;
    }
  } // namespace

  template <int dim>
  Pieces<dim>::Pieces(const LiquidDomain<dim> &domain, const Numbering &numbering)
    : domain(domain)
    , nodes(numbering.owned)
    , piece(numbering.number.size(), invalid)
  {
    const MPI_Comm       &comm  = domain.mesh.communicator();
    const Vector          label = label_connected_nodes(domain, numbering);
    std::set<GlobalIndex> here;
    for (const LocalIndex node : nodes)
      here.insert(label.local_element(node));
    const std::set<GlobalIndex>    all = everywhere(comm, here);
    const std::vector<GlobalIndex> labels(all.begin(), all.end());
    for (LocalIndex node = 0; node < piece.size(); ++node)
      if (label.local_element(node) >= 0)
        piece[node] = std::lower_bound(labels.begin(), labels.end(), label.local_element(node)) - labels.begin();

    sums.assign(n_sums * labels.size(), 0.);
    bounds.assign(2 * dim * labels.size(), -std::numeric_limits<double>::max());
    for (const LocalIndex node : nodes)
      add(piece[node], domain.mesh.node_position[node], domain.constrained[node] + 1u == 1u << dim);
    Utilities::MPI::sum(sums, comm, sums);
    Utilities::MPI::max(bounds, comm, bounds);
  }

  template <int dim>
  void
  Pieces<dim>::add(const unsigned int p, const Point<dim> &x, const bool is_held)
  {
    for (const unsigned int kind : {0, 1})
      if (kind == 0 || is_held)
        {
          double *sum = sums.data() + n_sums * p + (dim + 1) * kind;
          for (unsigned int d = 0; d < dim; ++d)
            sum[d] += x[d];
          sum[dim] += 1;
        }
    for (unsigned int d = 0; d < dim; ++d)
      {
        double *bound = bounds.data() + 2 * (dim * p + d);
        bound[0]      = std::max(bound[0], x[d]);
        bound[1]      = std::max(bound[1], -x[d]);
      }
  }

  template <int dim>
  Point<dim>
  Pieces<dim>::centre(const unsigned int p) const
  {
    const double *all = sums.data() + n_sums * p, *held = all + dim + 1, *sum = held[dim] > 0 ? held : all;
    Point<dim>    result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = sum[d] / sum[dim];
    return result;
  }

  template <int dim>
  double
  Pieces<dim>::size(const unsigned int p) const
  {
    double squares = 0;
    for (unsigned int d = 0; d < dim; ++d)
      squares += std::pow(bounds[2 * (dim * p + d)] + bounds[2 * (dim * p + d) + 1], 2);
    return std::sqrt(squares);
  }

  template <int dim>
  double
  Pieces<dim>::slenderness() const
  {
    const Mesh<dim>    &mesh = domain.mesh;
    std::vector<double> measures(2 * n(), 0.); // area and volume of each
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      if (domain.is_active_cell[c])
        measures[2 * piece[mesh.cell_nodes[c][0]] + 1] += domain.open_volume(c);
    for (LocalIndex f = 0; f < mesh.n_owned_faces(); ++f)
      if (const auto [i, j] = mesh.face_cells[f]; j != invalid && domain.is_active_cell[i] != domain.is_active_cell[j])
        measures[2 * piece[mesh.face_nodes[f][0]]] += domain.open_fraction[f] * mesh.face_area[f];
    Utilities::MPI::sum(measures, mesh.communicator(), measures);
    double result = 0;
    for (unsigned int p = 0; p < n(); ++p)
      if (measures[2 * p + 1] > 0)
        result = std::max(result, size(p) * measures[2 * p] / measures[2 * p + 1]);
    return result;
  }

  template <int dim>
  PartMotions
  Pieces<dim>::rotations(const double largest) const
  {
    PartMotions result;
    result.n_motions = dim * (dim - 1) / 2;
    std::vector<unsigned int> part(n(), invalid);
    for (unsigned int p = 0; p < n(); ++p)
      if (size(p) <= largest)
        part[p] = result.n_parts++;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const unsigned int p = piece[nodes[i]];
        if (part[p] == invalid)
          continue;
        const Tensor<1, dim> r = domain.mesh.node_position[nodes[i]] - centre(p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (domain.constrained[nodes[i]] >> d & 1)
              continue;
            result.rows.push_back(dim * i + d);
            result.part.push_back(part[p]);
            for (unsigned int k = 0; k < result.n_motions; ++k)
              result.values.push_back(turned(r, k)[d]);
          }
      }
    return result;
  }

  template class Pieces<2>;
  template class Pieces<3>;
} // namespace treacle
