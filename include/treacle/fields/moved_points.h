// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_fields_moved_points_h
#define treacle_fields_moved_points_h

#include <treacle/mesh/locator.h>

namespace treacle
{
  /// Of things that move with the liquid and have a position.
  template <typename Item>
  auto
  positions(const std::vector<Item> &items)
  {
    std::vector<decltype(Item::position)> x;
    x.reserve(items.size());
    for (const Item &item : items)
      x.push_back(item.position);
    return x;
  }

  /// Moves them into the mesh. Collective.
  template <int dim, typename Item>
  void
  clamp(const Mesh<dim> &mesh, std::vector<Item> &items)
  {
    const auto inside = mesh.locator().clamped(positions(items));
    for (unsigned int k = 0; k < items.size(); ++k)
      items[k].position = inside[k];
  }

  /// Each marker, material point or parcel on the rank that owns the cell it lies in, of a lattice the leaf.
  /// Collective.
  template <int dim, template <int> class Item>
  std::vector<Item<dim>>
  to_owners(const Mesh<dim> &mesh, const std::vector<Item<dim>> &items);
} // namespace treacle

#endif
