// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_mesh_leaf_h
#define treacle_mesh_leaf_h

#include <treacle/base/types.h>

namespace treacle
{
  /// Integer coordinates on the finest lattice: units of half a finest leaf.
  template <int dim>
  using LatticePoint = std::array<int, dim>;

  /// Pack lattice coordinates (21 bits each) into a key.
  template <int dim>
  inline VertexKey
  pack(const LatticePoint<dim> &p)
  {
    VertexKey key = 0;
    for (unsigned int d = 0; d < dim; ++d)
      key = (key << 21) | static_cast<VertexKey>(p[d]);
    return key;
  }

  template <int dim>
  inline LatticePoint<dim>
  unpack(VertexKey key)
  {
    LatticePoint<dim> p;
    for (int d = dim - 1; d >= 0; --d, key >>= 21)
      p[d] = static_cast<int>(key & ((1u << 21) - 1));
    return p;
  }

  /// The cube with this edge, a power of two, that contains a smaller one: their lowest corners.
  template <int dim>
  inline LatticePoint<dim>
  cube_around(LatticePoint<dim> cube, const int size)
  {
    for (int &i : cube)
      i &= ~(size - 1);
    return cube;
  }

  /// A leaf of the octree: its lowest corner and edge in lattice units.
  template <int dim>
  struct Leaf
  {
    LatticePoint<dim> origin;
    int               size;
    unsigned int      level;

    LatticePoint<dim>
    centre() const
    {
      LatticePoint<dim> c = origin;
      for (auto &x : c)
        x += size / 2;
      return c;
    }
  };

  /// The face, edge or corner neighbour of the same size as a known leaf.
  enum class Neighbour
  {
    outside,
    same,
    finer,
    coarser
  };
} // namespace treacle

#endif
