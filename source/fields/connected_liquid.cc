// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/fields/connected_liquid.h>

namespace treacle
{
  template <int dim>
  Vector
  label_pieces(const LiquidDomain<dim> &domain, const Numbering &cells)
  {
    // spread the smallest number through each connected set
    const Mesh<dim> &mesh  = domain.mesh;
    Vector           label = mesh.zeros(mesh.cells);
    for (LocalIndex c = 0; c < mesh.n_owned_cells(); ++c)
      label.local_element(c) = cells.number[c] == numbers::invalid_dof_index ?
                                 -1. :
                                 static_cast<double>(cells.number[c]);
    // the smallest label on top, or each smaller one would flood the rest again
    std::vector<LocalIndex> stack(cells.owned.rbegin(), cells.owned.rend());
    for (bool changed = true; changed;)
      {
        while (!stack.empty())
          {
            const LocalIndex c = stack.back();
            stack.pop_back();
            for (const LocalIndex f : mesh.cell_faces[c])
              for (const LocalIndex other : mesh.face_cells[f])
                if (other != invalid && other != c && domain.is_liquid_face(f) &&
                    other < mesh.n_owned_cells() && label.local_element(other) >= 0)
                  {
                    double &mine = label.local_element(c), &theirs = label.local_element(other);
                    if (theirs > mine)
                      {
                        theirs = mine;
                        stack.push_back(other);
                      }
                    else if (mine > theirs)
                      {
                        mine = theirs;
                        stack.push_back(c);
                      }
                  }
          }
        label.update_ghost_values();
        for (const LocalIndex c : cells.owned)
          for (const LocalIndex f : mesh.cell_faces[c])
            for (const LocalIndex other : mesh.face_cells[f])
              if (other != invalid && other >= mesh.n_owned_cells() && domain.is_liquid_face(f) &&
                  label.local_element(other) >= 0 &&
                  label.local_element(other) < label.local_element(c))
                {
                  label.local_element(c) = label.local_element(other);
                  stack.push_back(c);
                }
        label.zero_out_ghost_values();
        changed = Utilities::MPI::max(stack.empty() ? 0 : 1, mesh.communicator()) > 0;
      }
    label.update_ghost_values();
    return label;
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
  label_pieces(const LiquidDomain<2> &, const Numbering &);
  template Vector
  label_pieces(const LiquidDomain<3> &, const Numbering &);
} // namespace treacle
