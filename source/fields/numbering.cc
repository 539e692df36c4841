// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/fields/numbering.h>

namespace treacle
{
  Numbering::Numbering(const std::shared_ptr<const Utilities::MPI::Partitioner> &partitioner,
                       const std::vector<unsigned char>                         &is_active,
                       const unsigned int                                        n_components)
  {
    for (LocalIndex i = 0; i < partitioner->locally_owned_size(); ++i)
      if (is_active[i])
        owned.push_back(i);
    const MPI_Comm    comm    = partitioner->get_mpi_communicator();
    const GlobalIndex n_owned = owned.size();
    const GlobalIndex first   = sum_of_lower_ranks(comm, n_owned);

    // 0 says inactive
    Vector ids(partitioner);
    for (unsigned int i = 0; i < n_owned; ++i)
      ids.local_element(owned[i]) = first + i + 1;
    ids.update_ghost_values();
    number.resize(partitioner->locally_owned_size() + partitioner->n_ghost_indices());
    for (LocalIndex i = 0; i < number.size(); ++i)
      number[i] = ids.local_element(i) > 0 ?
                    static_cast<GlobalIndex>(ids.local_element(i)) - 1 :
                    numbers::invalid_dof_index;
    column.assign(number.size(), invalid);
    for (unsigned int i = 0; i < n_owned; ++i)
      column[owned[i]] = i;
    // ghosts are in the order of their global indices, and so are their numbers
    LocalIndex next = n_owned;
    for (LocalIndex i = partitioner->locally_owned_size(); i < number.size(); ++i)
      if (number[i] != numbers::invalid_dof_index)
        {
          column[i] = next++;
          for (unsigned int d = 0; d < n_components; ++d)
            ghost_columns.push_back(n_components * number[i] + d);
        }
    rows.set_size(n_components * Utilities::MPI::sum(n_owned, comm));
    rows.add_range(n_components * first, n_components * (first + n_owned));
  }
} // namespace treacle
