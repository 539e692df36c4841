// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exceptions.h>
#include <treacle/fields/connected_liquid.h>
#include <treacle/fields/full_container.h>
#include <treacle/pressure/closed_pockets.h>

#include <map>

namespace treacle
{
  template <int dim>
  ClosedPockets<dim>::ClosedPockets(const LiquidDomain<dim> &domain, const Numbering &cells)
    : domain(domain)
    , cells(cells)
  {
    const Vector                        label = label_connected(domain, cells);
    std::map<GlobalIndex, unsigned int> index;
    for (const GlobalIndex l : closed_labels(label))
      index.emplace(l, index.size());
    pockets.resize(index.size());
    for (unsigned int i = 0; i < cells.owned.size(); ++i)
      {
        const GlobalIndex l  = label.local_element(cells.owned[i]);
        const auto        it = index.find(l);
        if (it == index.end())
          continue;
        pockets[it->second].rows.push_back(i);
        if (cells.number[cells.owned[i]] == l)
          pinned_rows.push_back(i);
      }
    for (Pocket &pocket : pockets)
      {
        pocket.size =
          Utilities::MPI::sum<GlobalIndex>(pocket.rows.size(), domain.mesh.communicator());
        if (!domain.scene.emitters().empty())
          check_room(pocket);
      }
  }

  template <int dim>
  std::set<GlobalIndex>
  ClosedPockets<dim>::closed_labels(const Vector &label) const
  {
    const MPI_Comm       &comm = domain.mesh.communicator();
    std::set<GlobalIndex> closed, open;
    for (const LocalIndex c : cells.owned)
      (has_free_surface(domain, c) ? open : closed).insert(label.local_element(c));
    for (const GlobalIndex l : everywhere(comm, open))
      closed.erase(l);
    return everywhere(comm, closed);
  }

  template <int dim>
  void
  ClosedPockets<dim>::check_room(const Pocket &pocket) const
  {
    std::vector<LocalIndex> wet;
    for (const unsigned int i : pocket.rows)
      wet.push_back(cells.owned[i]);
    const Inflow inflow = inflow_into(domain, wet);
    // not what a few cells between an emitter and a wall see
    require(!inflow.is_too_much() || pocket.size < 100 ||
              2 * pocket.size <= cells.rows.size(),
            "Emitter: it pours " + digits(inflow.net) + (dim == 2 ? " m^2/s" : " m^3/s") +
              " into a closed container that is full of liquid; there is no room: leave air above the "
              "liquid, or set an earlier Stop time.");
  }

  template <int dim>
  void
  ClosedPockets<dim>::take_off_mean(Vector &q, const std::vector<double> &weight) const
  {
    for (const Pocket &pocket : pockets)
      {
        std::array<double, 2> sums{}; // of the weighted values, of the weights
        for (const unsigned int i : pocket.rows)
          {
            sums[0] += weight[i] * q.local_element(i);
            sums[1] += weight[i];
          }
        Utilities::MPI::sum(ArrayView<const double>(sums.data(), 2),
                            domain.mesh.communicator(),
                            ArrayView<double>(sums.data(), 2));
        for (const unsigned int i : pocket.rows)
          q.local_element(i) -= sums[0] / sums[1];
      }
  }

  template <int dim>
  void
  ClosedPockets<dim>::take_off_mean(Vector &q) const
  {
    std::vector<double> volume;
    for (const LocalIndex c : cells.owned)
      volume.push_back(domain.mesh.cell_volume[c]);
    take_off_mean(q, volume);
  }

  template <int dim>
  void
  ClosedPockets<dim>::take_off_pinned(Vector &q) const
  {
    std::vector<double> is_pinned(cells.owned.size(), 0.);
    for (const unsigned int i : pinned_rows)
      is_pinned[i] = 1;
    take_off_mean(q, is_pinned);
  }

  template <int dim>
  void
  ClosedPockets<dim>::balance(Vector &b) const
  {
    for (const Pocket &pocket : pockets)
      {
        double excess = 0;
        for (const unsigned int i : pocket.rows)
          excess += b.local_element(i);
        excess = Utilities::MPI::sum(excess, domain.mesh.communicator()) / pocket.size;
        for (const unsigned int i : pocket.rows)
          b.local_element(i) -= excess;
      }
  }

  template class ClosedPockets<2>;
  template class ClosedPockets<3>;
} // namespace treacle
