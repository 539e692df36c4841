// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_flood_h
#define treacle_fields_flood_h

#include <treacle/base/types.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

namespace treacle
{
  /// Spreads the smallest label through each connected set of the owned entries of a vector, over all
  /// ranks; entries without one have -1.
  /// `for_each_neighbour(i, visit)` calls visit with the entries next to an owned one, ghosts among them: of two, each has
  /// the other.
  template <typename ForEachNeighbour>
  class Flood
  {
  public:
    Flood(Vector &label, const ForEachNeighbour &for_each_neighbour)
      : label(label)
      , n_owned(label.locally_owned_size())
      , for_each_neighbour(for_each_neighbour)
    {
      for (LocalIndex i = 0; i < n_owned; ++i)
        if (label.local_element(i) >= 0)
          members.push_back(i);
    }

    /// Leaves ghosts up to date. Collective.
    void
    run()
    {
      // the smallest label on top, or each smaller one would flood the rest again
      stack = members;
      std::sort(stack.begin(), stack.end(), [&](const LocalIndex i, const LocalIndex j) {
        return label.local_element(i) > label.local_element(j);
      });
      do
        {
          spread();
          label.update_ghost_values();
          hear_from_ghosts();
          label.zero_out_ghost_values();
        }
      while (Utilities::MPI::max(stack.empty() ? 0 : 1, label.get_mpi_communicator()) > 0);
      label.update_ghost_values();
    }

  private:
    /// Among the entries of this rank.
    void
    spread()
    {
      while (!stack.empty())
        {
          const LocalIndex i = stack.back();
          stack.pop_back();
          for_each_neighbour(i, [&](const LocalIndex other) {
            if (other >= n_owned)
              return;
            double &mine = label.local_element(i), &theirs = label.local_element(other);
            if (theirs == mine || theirs < 0)
              return;
            stack.push_back(theirs > mine ? other : i);
            theirs = mine = std::min(mine, theirs);
          });
        }
    }

    void
    hear_from_ghosts()
    {
      if (label.get_partitioner()->n_ghost_indices() == 0)
        return;
      for (const LocalIndex i : members)
        for_each_neighbour(i, [&](const LocalIndex other) {
          const double theirs = label.local_element(other);
          if (other < n_owned || theirs < 0 || theirs >= label.local_element(i))
            return;
          label.local_element(i) = theirs;
          stack.push_back(i);
        });
    }

    Vector                 &label;
    const LocalIndex        n_owned;
    const ForEachNeighbour &for_each_neighbour;
    std::vector<LocalIndex> members, stack;
  };
} // namespace treacle

#endif
