// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/marker.h>
#include <treacle/fields/material_point.h>
#include <treacle/fields/moved_points.h>
#include <treacle/fields/parcel.h>

namespace treacle
{
  template <int dim, template <int> class Item>
  std::vector<Item<dim>>
  to_owners(const Mesh<dim> &mesh, const std::vector<Item<dim>> &items)
  {
    const MPI_Comm    &comm    = mesh.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return items;
    const auto                           owner = mesh.locator().owners(positions(items));
    PerRank<typename Item<dim>::Numbers> to_rank(n_ranks);
    for (unsigned int k = 0; k < items.size(); ++k)
      to_rank[owner[k].rank].push_back(items[k].numbers());
    std::vector<Item<dim>> owned;
    for (const auto &received : send_and_receive(comm, to_rank))
      for (const auto &numbers : received)
        owned.push_back(Item<dim>::from(numbers.data()));
    return owned;
  }

#define INSTANTIATE(dim)                                                        \
  template std::vector<Marker<dim>> to_owners(const Mesh<dim> &,                \
                                              const std::vector<Marker<dim>> &); \
  template std::vector<MaterialPoint<dim>> to_owners(const Mesh<dim> &,         \
                                                     const std::vector<MaterialPoint<dim>> &);  \
  template std::vector<Parcel<dim>> to_owners(const Mesh<dim> &, const std::vector<Parcel<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace treacle
