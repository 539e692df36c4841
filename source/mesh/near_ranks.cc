// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/locator.h>
#include <treacle/mesh/near_ranks.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    bool
    overlap(const BoundingBox<dim> &a, const BoundingBox<dim> &b)
    {
      const auto &[a_lower, a_upper] = a.get_boundary_points();
      const auto &[b_lower, b_upper] = b.get_boundary_points();
      for (unsigned int d = 0; d < dim; ++d)
        if (a_upper[d] < b_lower[d] || b_upper[d] < a_lower[d])
          return false;
      return true;
    }
  } // namespace

  template <int dim>
  NearRanks<dim>::NearRanks(const Mesh<dim> &mesh, const double margin)
    : rank(Utilities::MPI::this_mpi_process(mesh.communicator()))
    , grid(mesh, std::max(0.25 * margin, mesh.finest_size()))
    , margin(margin)
    , boxes(mesh.locator().rank_boxes())
  {}

  template <int dim>
  const std::vector<unsigned int> &
  NearRanks<dim>::near(const LatticePoint<dim> &cube) const
  {
    const auto [entry, is_new] = known.try_emplace(pack<dim>(cube));
    if (is_new)
      {
        BoundingBox<dim> around = grid.box_of(cube);
        around.extend(margin);
        for (unsigned int r = 0; r < boxes.size(); ++r)
          if (r != rank && std::any_of(boxes[r].begin(), boxes[r].end(), [&](const auto &box) {
                return overlap(box, around);
              }))
            entry->second.push_back(r);
      }
    return entry->second;
  }

  template class NearRanks<2>;
  template class NearRanks<3>;
} // namespace treacle
