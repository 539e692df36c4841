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
  to_owners(const Mesh<dim> &mesh, const std::vector<Marker<dim>> &markers)
  {
    const MPI_Comm    &comm    = mesh.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return markers;
    const unsigned int      rank = Utilities::MPI::this_mpi_process(comm);
    const Locator<dim>     &locator = mesh.locator();
    std::vector<Point<dim>> elsewhere;
    std::vector<bool>       is_here;
    for (const Marker<dim> &marker : markers)
      {
        is_here.push_back(locator.locate(marker.position).cell != invalid);
        if (!is_here.back())
          elsewhere.push_back(marker.position);
      }
    const auto                             owner = locator.owners(elsewhere);
    PerRank<typename Marker<dim>::Numbers> to_rank(n_ranks);
    unsigned int                           next = 0;
    for (unsigned int k = 0; k < markers.size(); ++k)
      to_rank[is_here[k] ? rank : owner[next++].rank].push_back(markers[k].numbers());
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
  to_owners(const Mesh<2> &, const std::vector<Marker<2>> &);
  template std::vector<Marker<3>>
  to_owners(const Mesh<3> &, const std::vector<Marker<3>> &);
} // namespace treacle
