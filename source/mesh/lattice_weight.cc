// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/lattice_weight.h>

#include <optional>

namespace treacle
{
  namespace
  {
    /// Weight of a vertex, in units of the squared half edge, if leaf k of the 2^dim of
    /// this edge around it is there and has it as its centre, or midpoint of a face or an
    /// edge.
    template <int dim>
    std::optional<double>
    weight_in_leaf(const Octree<dim>       &octree,
                   const LatticePoint<dim> &vertex,
                   const int                edge,
                   const unsigned int       k)
    {
      using W = LatticeWeights<dim>;

      LatticePoint<dim> origin;
      unsigned int      n_odd = 0, n_box = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const bool odd = (vertex[d] / (edge / 2)) % 2 == 1;
          n_odd += odd;
          n_box += !odd && (vertex[d] == 0 || vertex[d] == octree.extent()[d]);
          origin[d] = vertex[d] - (odd ? edge / 2 : (k >> d & 1) * edge);
          if (origin[d] < 0 || origin[d] >= octree.extent()[d])
            return {};
        }
      const LocalIndex leaf = octree.leaf_at(origin);
      if (leaf == invalid || octree.leaves()[leaf].size != edge)
        return {};
      return n_odd == dim                         ? W::centre :
             dim == 3 && n_odd == 2 && n_box == 1 ? W::box_centre :
                                                    W::hanging;
    }
  } // namespace

  template <int dim>
  double
  lattice_weight(const Octree<dim> &octree, const LatticePoint<dim> &vertex)
  {
    // the largest power of two that divides all coordinates
    int bits = 1 << 20;
    for (const int x : vertex)
      bits |= x;
    const int    edge = 2 * (bits & -bits);
    const double half = 0.5 * edge * octree.finest_size() / 2;

    // otherwise a corner of leaves that are smaller
    for (unsigned int k = 0; k < (1u << dim); ++k)
      if (const auto weight = weight_in_leaf<dim>(octree, vertex, edge, k))
        return *weight * (half * half);
    return 0;
  }

  template double
  lattice_weight<2>(const Octree<2> &, const LatticePoint<2> &);
  template double
  lattice_weight<3>(const Octree<3> &, const LatticePoint<3> &);
} // namespace treacle
