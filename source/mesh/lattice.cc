// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#include <treacle/mesh/lattice.h>

namespace treacle
{
  namespace
  {
    template <int dim>
    LatticePoint<dim>
    midpoint(const LatticePoint<dim> &a, const LatticePoint<dim> &b)
    {
      LatticePoint<dim> m;
      for (unsigned int d = 0; d < dim; ++d)
        m[d] = (a[d] + b[d]) / 2;
      return m;
    }

    /// Twice or six times the signed volume, in lattice units.
    template <int dim>
    long
    orientation(const typename Lattice<dim>::Cell &x)
    {
      long e[dim][dim];
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          e[i][d] = x[i + 1][d] - x[0][d];
      if constexpr (dim == 2)
        return e[0][0] * e[1][1] - e[0][1] * e[1][0];
      else
        return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
               e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }

    /// Fills the cells over one face of one leaf: design of the templates in
    /// doc/mesh.md.
    template <int dim>
    class FaceFiller
    {
    public:
      FaceFiller(const Octree<dim> &octree, std::vector<typename Lattice<dim>::Cell> &cells)
        : octree(octree)
        , cells(cells)
      {}

      void
      fill(const Leaf<dim> &leaf, const unsigned int axis, const bool upper)
      {
        LatticePoint<dim> offset{};
        offset[axis]          = upper ? 1 : -1;
        const Neighbour other = octree.neighbour(leaf, offset);
        if (other == Neighbour::same && !upper)
          return; // the lower leaf of a pair fills it
        if constexpr (dim == 2)
          fill_edge(leaf, axis, upper, other);
        else
          fill_square(leaf, axis, upper, other);
      }

    private:
      void
      add(typename Lattice<dim>::Cell cell)
      {
        if (orientation<dim>(cell) < 0)
          std::swap(cell[dim - 1], cell[dim]);
        cells.push_back(cell);
      }

      void
      fill_edge(const Leaf<dim>    &leaf,
                const unsigned int  axis,
                const bool          upper,
                const Neighbour     other)
      {
        if constexpr (dim == 2)
          {
            const LatticePoint<dim> c = leaf.centre();
            LatticePoint<dim>       a = leaf.origin, b;
            a[axis] += upper ? leaf.size : 0;
            b = a;
            b[1 - axis] += leaf.size;
            if (other == Neighbour::finer)
              {
                const LatticePoint<dim> e = midpoint<dim>(a, b);
                add({{c, a, e}});
                add({{c, e, b}});
              }
            else if (other == Neighbour::same)
              {
                LatticePoint<dim> c2 = c;
                c2[axis] += leaf.size;
                add({{c, c2, a}});
                add({{c, c2, b}});
              }
            else
              add({{c, a, b}});
          }
      }

      void
      fill_square(const Leaf<3>     &leaf,
                  const unsigned int axis,
                  const bool         upper,
                  const Neighbour    other);

      const Octree<dim>                       &octree;
      std::vector<typename Lattice<dim>::Cell> &cells;
    };

    template <>
    void
    FaceFiller<3>::fill_square(const Leaf<3>     &leaf,
                               const unsigned int axis,
                               const bool         upper,
                               const Neighbour    other)
    {
      const unsigned int    u = (axis + 1) % 3, w = (axis + 2) % 3;
      const int             s = leaf.size;
      const LatticePoint<3> c = leaf.centre();

      // corners around the face; edge q runs from corner q to corner q+1
      std::array<LatticePoint<3>, 4> corner;
      for (unsigned int q = 0; q < 4; ++q)
        {
          corner[q] = leaf.origin;
          corner[q][axis] += upper ? s : 0;
          corner[q][u] += (q == 1 || q == 2) ? s : 0;
          corner[q][w] += (q == 2 || q == 3) ? s : 0;
        }

      if (other == Neighbour::coarser)
        {
          // the diagonal joins the corners of even parity on the grid of size s
          const unsigned int q =
            (corner[0][u] / s + corner[0][w] / s) % 2 == 0 ? 0 : 1;
          add({{c, corner[q], corner[q + 1], corner[q + 2]}});
          add({{c, corner[q], corner[q + 2], corner[(q + 3) % 4]}});
          return;
        }

      std::array<bool, 4> split;
      for (unsigned int q = 0; q < 4; ++q)
        {
          LatticePoint<3> beside{}, across{}, diagonal{};
          beside[q % 2 == 0 ? w : u] = (q == 0 || q == 3) ? -1 : 1;
          across[axis]               = upper ? 1 : -1;
          diagonal                   = beside;
          diagonal[axis]             = across[axis];
          split[q] = other == Neighbour::finer ||
                     octree.neighbour(leaf, beside) == Neighbour::finer ||
                     octree.neighbour(leaf, diagonal) == Neighbour::finer;
        }

      // what the ring around the axis is joined to
      LatticePoint<3> far = midpoint<3>(corner[0], corner[2]);
      if (other == Neighbour::same)
        {
          far = c;
          far[axis] += s;
        }

      std::array<LatticePoint<3>, 8> ring;
      unsigned int                   n = 0;
      for (unsigned int q = 0; q < 4; ++q)
        {
          const unsigned int    before = (q + 3) % 4;
          const LatticePoint<3> e1 = midpoint<3>(corner[before], corner[q]);
          const LatticePoint<3> e2 = midpoint<3>(corner[q], corner[(q + 1) % 4]);
          if (other != Neighbour::finer && split[before] && split[q])
            {
              add({{corner[q], e1, e2, c}});
              if (other == Neighbour::same)
                add({{corner[q], e1, e2, far}});
            }
          else
            ring[n++] = corner[q];
          if (split[q])
            ring[n++] = e2;
        }
      for (unsigned int i = 0; i < n; ++i)
        add({{c, far, ring[i], ring[(i + 1) % n]}});
    }
  } // namespace

  template <int dim>
  Lattice<dim>
  make_lattice(const Octree<dim> &octree)
  {
    Lattice<dim> lattice;
    lattice.start.reserve(2 * dim * octree.n_owned_leaves() + 1);
    lattice.cells.reserve((dim == 2 ? 5 : 14) * octree.n_owned_leaves());
    FaceFiller<dim> filler(octree, lattice.cells);
    for (unsigned int l = 0; l < octree.n_owned_leaves(); ++l)
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const bool upper : {false, true})
          {
            lattice.start.push_back(lattice.cells.size());
            filler.fill(octree.leaves()[l], axis, upper);
          }
    lattice.start.push_back(lattice.cells.size());
    return lattice;
  }

  template <int dim>
  double
  lattice_weight(const Octree<dim> &octree, const LatticePoint<dim> &vertex)
  {
    using W = LatticeWeights<dim>;

    // the largest power of two that divides all coordinates
    int bits = 1 << 20;
    for (const int x : vertex)
      bits |= x;
    const int s       = bits & -bits;
    const double unit = octree.finest_size() / 2;

    const auto squared_half_edge = [&](const int size) {
      return (0.5 * size * unit) * (0.5 * size * unit);
    };

    // a centre of a leaf of edge 2s, or a midpoint of one of its faces or
    // edges, or a corner of leaves that are not larger than s
    for (unsigned int k = 0; k < (1u << dim); ++k)
      {
        LatticePoint<dim> origin;
        unsigned int      n_odd = 0, n_box = 0;
        bool              inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const bool odd = (vertex[d] / s) % 2 == 1;
            n_odd += odd;
            n_box += !odd && (vertex[d] == 0 || vertex[d] == octree.extent()[d]);
            origin[d] = vertex[d] - (odd ? s : (k >> d & 1) * 2 * s);
            inside    = inside && origin[d] >= 0 && origin[d] < octree.extent()[d];
          }
        if (!inside)
          continue;
        const LocalIndex leaf = octree.leaf_at(origin);
        if (leaf == invalid || octree.leaves()[leaf].size != 2 * s)
          continue;
        const double factor = n_odd == dim ? W::centre :
                              dim == 3 && n_odd == 2 && n_box == 1 ?
                                             W::box_centre :
                                             W::hanging;
        return factor * squared_half_edge(2 * s);
      }
    return 0;
  }

  template struct Lattice<2>;
  template struct Lattice<3>;
  template Lattice<2>
  make_lattice(const Octree<2> &);
  template Lattice<3>
  make_lattice(const Octree<3> &);
  template double
  lattice_weight<2>(const Octree<2> &, const LatticePoint<2> &);
  template double
  lattice_weight<3>(const Octree<3> &, const LatticePoint<3> &);
} // namespace treacle
