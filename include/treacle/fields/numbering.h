// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_numbering_h
#define treacle_fields_numbering_h

#include <treacle/base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace treacle
{
  /// The active ones among all nodes or cells, numbered without gaps.
  struct Numbering
  {
    /// @p is_active for owned entries at least. Collective.
    Numbering(const std::shared_ptr<const Utilities::MPI::Partitioner> &partitioner,
              const std::vector<unsigned char>                         &is_active,
              const unsigned int                                        n_components = 1);

    std::vector<LocalIndex>  owned;  ///< active and owned
    std::vector<GlobalIndex> number; ///< of each owned or ghost entry, or invalid_dof_index
    IndexSet                 rows;   ///< of this rank, n_components for each

    // -- as columns of a matrix --
    std::vector<GlobalIndex> ghost_columns; ///< n_components for each active ghost, ascending
    /// Of each owned or ghost entry, its place among the owned and then the ghosts that are
    /// active, or invalid; its first column is n_components times that.
    std::vector<LocalIndex> column;
  };
} // namespace treacle

#endif
