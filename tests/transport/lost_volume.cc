// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

// Volume that a wall pushes out goes to the pressure cells in front of it: all of it, none where no liquid is near, and evenly where
// its place is between cells, as those of a surface's vertices are, so that a hundred thousandth of a leaf does not tell which of them.

#include <treacle/transport/lost_volume.h>

#include "../body.h"

namespace tests::transport_lost_volume
{
  namespace
  {
    /// Of a volume of 1 at a point of a wall, which one rank knows.
    template <int dim>
    treacle::Vector
    by_cells(const Body<dim> &body, const Point<dim> &entry, const double outward)
    {
      std::vector<LostVolume<dim>> lost;
      if (Utilities::MPI::this_mpi_process(body.state.mesh->communicator()) == 0)
        lost.push_back({entry, outward * Point<dim>::unit_vector(dim - 1), 1});
      return lost_by_cells(body.domain, lost);
    }

    template <int dim>
    void
    check(const MPI_Comm &comm)
    {
      const Body<dim> body(comm,
                           "subsection Mesh\nset Surface level = 4\nset Interior level = 4\nset Air level = 2\nend\n"
                           "subsection Liquid 1\nset Shape = half space\nset Centre = " +
                             std::string(dim == 2 ? "0, 0.31\nset Normal = 0, 1" : "0, 0, 0.31\nset Normal = 0, 0, 1") + "\nend\n");
      const auto      sum = [&](const treacle::Vector &volume) {
        double here = 0;
        for (LocalIndex c = 0; c < volume.locally_owned_size(); ++c)
          here += volume.local_element(c);
        return Utilities::MPI::sum(here, comm);
      };
      const double little = 1e-5 * body.state.mesh->finest_size();
      Point<dim>   left = diagonal_point<dim>(0.5), at_ceiling = left;
      left[dim - 1]       = 0;
      at_ceiling[dim - 1] = 1;
      Point<dim> right    = left;
      left[0] -= little;
      right[0] += little;
      const treacle::Vector volume = by_cells<dim>(body, left, 1);
      treacle::Vector       change = volume;
      change -= by_cells<dim>(body, right, 1);
      const double largest = change.linfty_norm();
      out() << dim << "D: " << (std::abs(sum(volume) - 1) < 1e-12 ? "all" : "NOT ALL") << " of it in front of the floor, "
            << (sum(by_cells<dim>(body, at_ceiling, -1)) == 0 ? "nothing" : "SOMETHING") << " below the ceiling; by cells, on one side of a leaf and on the other: "
            << (largest < 1e-4 ? "alike to 1e-4" : "OTHER, " + digits(largest)) << std::endl;
    }
  } // namespace

  void
  start(const int, char **)
  {
    on_1_2_3_ranks([](const MPI_Comm &comm) {
      check<2>(comm);
      check<3>(comm);
    });
  }

  const Test test("transport/lost_volume", start);
} // namespace tests::transport_lost_volume
