// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/connected_liquid.h>

namespace treacle
{
  namespace
  {
    /// Spreads the smallest number through each connected set.
    template <int dim>
    class Flood
    {
    public:
      Flood(const LiquidDomain<dim> &domain, const Numbering &cells)
        : label(domain.mesh.zeros(domain.mesh.cells))
        , domain(domain)
        , mesh(domain.mesh)
        , cells(cells)
        // the smallest label on top, or each smaller one would flood the rest again
        , stack(cells.owned.rbegin(), cells.owned.rend())
      {
        for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
          label.local_element(c) = cells.number[c] == numbers::invalid_dof_index ?
                                     -1. :
                                     static_cast<double>(cells.number[c]);
      }

      void
      run()
      {
        do
          {
            spread();
            label.update_ghost_values();
            hear_from_ghosts();
            label.zero_out_ghost_values();
          }
        while (Utilities::MPI::max(stack.empty() ? 0 : 1, mesh.communicator()) > 0);
        label.update_ghost_values();
      }

      Vector label;

    private:
      /// Call @p visit with the numbered cells across liquid faces, owned ones or ghosts.
      template <typename Visit>
      void
      for_each_neighbour(const LocalIndex c, const bool owned, const Visit &visit) const
      {
        for (const LocalIndex f : mesh.cell_faces[c])
          for (const LocalIndex other : mesh.face_cells[f])
            if (other != invalid && other != c && domain.is_liquid_face(f) &&
                (other < mesh.n_owned_cells()) == owned && label.local_element(other) >= 0)
              visit(other);
      }

      /// Among the cells of this rank.
      void
      spread()
      {
        while (!stack.empty())
          {
            const LocalIndex c = stack.back();
            stack.pop_back();
            for_each_neighbour(c, true, [&](const LocalIndex other) {
              double &mine = label.local_element(c), &theirs = label.local_element(other);
              if (theirs == mine)
                return;
              stack.push_back(theirs > mine ? other : c);
              theirs = mine = std::min(mine, theirs);
            });
          }
      }

      void
      hear_from_ghosts()
      {
        for (const LocalIndex c : cells.owned)
          for_each_neighbour(c, false, [&](const LocalIndex other) {
            if (label.local_element(other) >= label.local_element(c))
              return;
            label.local_element(c) = label.local_element(other);
            stack.push_back(c);
          });
      }

      const LiquidDomain<dim> &domain;
      const Mesh<dim>         &mesh;
      const Numbering         &cells;
      std::vector<LocalIndex>  stack;
    };
  } // namespace

  template <int dim>
  Vector
  label_connected(const LiquidDomain<dim> &domain, const Numbering &cells)
  {
    Flood<dim> flood(domain, cells);
    flood.run();
    return std::move(flood.label);
  }

  std::set<GlobalIndex>
  everywhere(const MPI_Comm &comm, const std::set<GlobalIndex> &here)
  {
    std::set<GlobalIndex> all;
    for (const auto &part :
         Utilities::MPI::all_gather(comm, std::vector<GlobalIndex>(here.begin(), here.end())))
      all.insert(part.begin(), part.end());
    return all;
  }

  template Vector
  label_connected(const LiquidDomain<2> &, const Numbering &);
  template Vector
  label_connected(const LiquidDomain<3> &, const Numbering &);
} // namespace treacle
