// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/near_ranks.h>

namespace treacle
{
  namespace
  {
    /// Boxes around the cells on consecutive runs of owned leaves: a few tight ones say more
    /// than one around all.
    template <int dim>
    std::vector<BoundingBox<dim>>
    covering_boxes(const Octree<dim> &octree, const double margin)
    {
      constexpr unsigned int        n_boxes = 64;
      const unsigned int            n       = octree.n_owned_leaves();
      std::vector<BoundingBox<dim>> boxes;
      Tensor<1, dim>                diagonal_vector;
      for (unsigned int d = 0; d < dim; ++d)
        diagonal_vector[d] = 1;
      for (unsigned int k = 0; k < n_boxes; ++k)
        {
          const unsigned int begin = static_cast<std::uint64_t>(n) * k / n_boxes;
          const unsigned int end   = static_cast<std::uint64_t>(n) * (k + 1) / n_boxes;
          if (begin == end)
            continue;
          std::vector<Point<dim>> corners;
          for (unsigned int l = begin; l < end; ++l)
            {
              const Leaf<dim>  &leaf = octree.leaves()[l];
              LatticePoint<dim> top  = leaf.origin;
              for (int &i : top)
                i += leaf.size;
              // cells reach to the centre of a leaf beside
              const Tensor<1, dim> beyond =
                (margin + 0.5 * octree.size(leaf)) * diagonal_vector;
              corners.push_back(octree.position(leaf.origin) - beyond);
              corners.push_back(octree.position(top) + beyond);
            }
          boxes.emplace_back(corners);
        }
      return boxes;
    }
  } // namespace

  template <int dim>
  NearRanks<dim>::NearRanks(const Octree<dim> &octree, const double margin)
    : rank(Utilities::MPI::this_mpi_process(octree.communicator()))
    , boxes(Utilities::MPI::all_gather(octree.communicator(), covering_boxes(octree, margin)))
  {}

  template class NearRanks<2>;
  template class NearRanks<3>;
} // namespace treacle
