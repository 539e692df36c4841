// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/marker.h>

namespace treacle
{
  template <int dim>
  std::vector<Point<dim>>
  positions(const std::vector<Marker<dim>> &markers)
  {
    std::vector<Point<dim>> x;
    x.reserve(markers.size());
    for (const Marker<dim> &marker : markers)
      x.push_back(marker.position);
    return x;
  }

  template <int dim>
  std::vector<Marker<dim>>
  to_owners(const Octree<dim> &octree, const std::vector<Marker<dim>> &markers)
  {
    const MPI_Comm    &comm    = octree.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return markers;
    const unsigned int      rank = Utilities::MPI::this_mpi_process(comm);
    std::vector<Point<dim>> elsewhere;
    std::vector<bool>       is_here;
    for (const Marker<dim> &marker : markers)
      {
        const LocalIndex leaf = octree.leaf_containing(marker.position);
        is_here.push_back(leaf != invalid && leaf < octree.n_owned_leaves());
        if (!is_here.back())
          elsewhere.push_back(marker.position);
      }
    const std::vector<unsigned int>               owner = octree.owner_ranks(elsewhere);
    PerRank<typename Marker<dim>::Numbers> to_rank(n_ranks);
    unsigned int                                  next = 0;
    for (unsigned int k = 0; k < markers.size(); ++k)
      to_rank[is_here[k] ? rank : owner[next++]].push_back(markers[k].numbers());
    std::vector<Marker<dim>> owned;
    for (const auto &received : send_and_receive(comm, to_rank))
      for (const auto &numbers : received)
        owned.push_back(Marker<dim>::from(numbers.data()));
    return owned;
  }

  template std::vector<Point<2>>
  positions(const std::vector<Marker<2>> &);
  template std::vector<Point<3>>
  positions(const std::vector<Marker<3>> &);
  template std::vector<Marker<2>>
  to_owners(const Octree<2> &, const std::vector<Marker<2>> &);
  template std::vector<Marker<3>>
  to_owners(const Octree<3> &, const std::vector<Marker<3>> &);
} // namespace treacle
