// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/base/exchange.h>
#include <treacle/mesh/near_ranks.h>
#include <treacle/surface/near_markers.h>

namespace treacle
{
  template <int dim>
  NearMarkers<dim>::NearMarkers(const Mesh<dim>                &mesh,
                                const std::vector<Marker<dim>> &markers,
                                const double                    reach,
                                const double                    beyond)
    : comm(mesh.communicator())
    , grid(mesh, reach)
  {
    const NearRanks<dim>                   near(mesh, reach + beyond);
    PerRank<typename Marker<dim>::Numbers> to_rank(near.n_ranks());
    sent.resize(near.n_ranks());
    for (unsigned int k = 0; k < markers.size(); ++k)
      {
        all.push_back({markers[k], 0.});
        const Point<dim> &x = markers[k].position;
        near.for_each(x, x, [&](const unsigned int r) {
          to_rank[r].push_back(markers[k].numbers());
          sent[r].push_back(k);
        });
      }
    for (const auto &received : send_and_receive(comm, to_rank))
      for (const auto &numbers : received)
        all.push_back({Marker<dim>::from(numbers.data()), 0.});
    sort_into_cubes();
  }

  template <int dim>
  void
  NearMarkers<dim>::set_values(const std::vector<double> &values)
  {
    unsigned int next = 0;
    for (const double value : values)
      all[place[next++]].value = value;
    PerRank<double> to_rank(sent.size());
    for (unsigned int r = 0; r < sent.size(); ++r)
      for (const unsigned int k : sent[r])
        to_rank[r].push_back(values[k]);
    for (const auto &received : send_and_receive(comm, to_rank))
      for (const double value : received)
        all[place[next++]].value = value;
  }

  namespace
  {
    /// Of a cube, or @p shift cubes along x from it: cubes of a row have one key after another.
    template <int dim>
    VertexKey
    key_in_row(LatticePoint<dim> cube, const int shift = 0)
    {
      cube[0] += shift;
      std::reverse(cube.begin(), cube.end());
      return pack<dim>(cube);
    }
  } // namespace

  template <int dim>
  void
  NearMarkers<dim>::sort_into_cubes()
  {
    std::vector<std::pair<VertexKey, unsigned int>> order;
    for (unsigned int k = 0; k < all.size(); ++k)
      order.emplace_back(key_in_row<dim>(grid.cube_of(all[k].marker.position)), k);
    // in an order that no partition changes: sums and ties depend on it
    std::sort(order.begin(), order.end(), [&](const auto &a, const auto &b) {
      return a.first != b.first ?
               a.first < b.first :
               all[a.second].marker.numbers() < all[b.second].marker.numbers();
    });
    std::vector<NearMarker<dim>> sorted;
    sorted.reserve(all.size());
    place.resize(all.size());
    for (const auto &[key, k] : order)
      {
        place[k] = sorted.size();
        sorted.push_back(all[k]);
      }
    all = std::move(sorted);
    for (const NearMarker<dim> &m : all)
      position.push_back(m.marker.position);
    for (unsigned int begin = 0, end = 0; begin < all.size(); begin = end)
      {
        while (end < all.size() && order[end].first == order[begin].first)
          ++end;
        const LatticePoint<dim> cube = grid.cube_of(all[begin].marker.position);
        for (int shift = cube[0] > 0 ? -1 : 0; shift <= 1; ++shift)
          rows.emplace(key_in_row<dim>(cube, shift), std::make_pair(begin, end)).first->second.second = end;
      }
  }

  template <int dim>
  void
  NearMarkers<dim>::append_around(const Point<dim>                     &x,
                                  std::vector<const NearMarker<dim> *> &result) const
  {
    const double reach = grid.edge;
    Point<dim>   lower = x, upper = x;
    for (unsigned int d = 1; d < dim; ++d)
      {
        lower[d] -= reach;
        upper[d] += reach;
      }
    grid.for_each(lower, upper, [&](const LatticePoint<dim> &cube) {
      const auto found = rows.find(key_in_row<dim>(cube));
      if (found == rows.end())
        return;
      // without branches: which ones are near enough cannot be foreseen
      const auto [begin, end] = found->second;
      std::size_t n           = result.size();
      result.resize(n + end - begin);
      for (unsigned int k = begin; k < end; ++k)
        {
          result[n] = &all[k];
          n += (position[k] - x).norm_square() < reach * reach;
        }
      result.resize(n);
    });
  }

  template <int dim>
  MarkersWithinLeaves<dim>::MarkersWithinLeaves(const Mesh<dim>                &mesh,
                                                const std::vector<Marker<dim>> &markers,
                                                const double                    leaves,
                                                const double                    beyond)
    : finest(mesh.finest_size())
  {
    of_size.emplace_back(mesh, markers, leaves * finest, beyond * finest);
    if (mesh.is_lattice())
      for (double size = 2 * finest; size < 1.5 * mesh.surface_size(); size *= 2)
        of_size.emplace_back(mesh, markers, leaves * size, beyond * size);
  }

  template <int dim>
  void
  MarkersWithinLeaves<dim>::set_values(const std::vector<double> &values)
  {
    for (NearMarkers<dim> &markers : of_size)
      markers.set_values(values);
  }

  template <int dim>
  void
  MarkersWithinLeaves<dim>::append_around(const Point<dim>                     &x,
                                          const double                          size,
                                          std::vector<const NearMarker<dim> *> &result) const
  {
    of_size[std::lround(std::log2(size / finest))].append_around(x, result);
  }

  template class MarkersWithinLeaves<2>;
  template class MarkersWithinLeaves<3>;
  template class NearMarkers<2>;
  template class NearMarkers<3>;
} // namespace treacle
