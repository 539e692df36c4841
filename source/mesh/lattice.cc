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
      FaceFiller(const Octree<dim>                        &octree,
                 std::vector<typename Lattice<dim>::Cell> &cells)
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
      fill_edge(const Leaf<dim>   &leaf,
                const unsigned int axis,
                const bool         upper,
                const Neighbour    other)
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

      /// A face of a leaf in 3D; edge q runs from corner q to corner q+1.
      struct Square
      {
        Square(const Leaf<3> &leaf, const unsigned int axis, const bool upper);

        const Leaf<3>                 &leaf;
        unsigned int                   axis, u, w; ///< u and w lie in the face
        int                            side;       ///< of the leaf, -1 or 1
        std::array<LatticePoint<3>, 4> corner;
      };

      /// The two cells over a face that is a quarter of a coarser leaf's.
      void
      fill_halves(const Square &square);

      /// Does a finer leaf beside the edges of a face split them?
      std::array<bool, 4>
      find_split(const Square &square, const Neighbour other) const;

      /// The cells around the line from the centre to the face, or to the other leaf's.
      void
      fill_ring(const Square &square, const Neighbour other);

      const Octree<dim>                        &octree;
      std::vector<typename Lattice<dim>::Cell> &cells;
    };

    template <>
    FaceFiller<3>::Square::Square(const Leaf<3>     &leaf,
                                  const unsigned int axis,
                                  const bool         upper)
      : leaf(leaf)
      , axis(axis)
      , u((axis + 1) % 3)
      , w((axis + 2) % 3)
      , side(upper ? 1 : -1)
    {
      const int s = leaf.size;
      for (unsigned int q = 0; q < 4; ++q)
        {
          corner[q] = leaf.origin;
          corner[q][axis] += upper ? s : 0;
          corner[q][u] += (q == 1 || q == 2) ? s : 0;
          corner[q][w] += (q == 2 || q == 3) ? s : 0;
        }
    }

    template <>
    void
    FaceFiller<3>::fill_halves(const Square &square)
    {
      // the diagonal joins the corners of even parity on the grid of the leaf's size
      const auto           &corner = square.corner;
      const LatticePoint<3> c      = square.leaf.centre();
      const int             s      = square.leaf.size;
      const unsigned int    q =
        (corner[0][square.u] / s + corner[0][square.w] / s) % 2 == 0 ? 0 : 1;
      add({{c, corner[q], corner[q + 1], corner[q + 2]}});
      add({{c, corner[q], corner[q + 2], corner[(q + 3) % 4]}});
    }

    template <>
    std::array<bool, 4>
    FaceFiller<3>::find_split(const Square &square, const Neighbour other) const
    {
      std::array<bool, 4> split;
      for (unsigned int q = 0; q < 4; ++q)
        {
          LatticePoint<3> beside{};
          beside[q % 2 == 0 ? square.w : square.u] = (q == 0 || q == 3) ? -1 : 1;
          LatticePoint<3> diagonal                 = beside;
          diagonal[square.axis]                    = square.side;

          split[q] = other == Neighbour::finer ||
                     octree.neighbour(square.leaf, beside) == Neighbour::finer ||
                     octree.neighbour(square.leaf, diagonal) == Neighbour::finer;
        }
      return split;
    }

    template <>
    void
    FaceFiller<3>::fill_ring(const Square &square, const Neighbour other)
    {
      const auto               &corner = square.corner;
      const std::array<bool, 4> split  = find_split(square, other);
      const LatticePoint<3>     c      = square.leaf.centre();
      LatticePoint<3>           far    = midpoint<3>(corner[0], corner[2]);
      if (other == Neighbour::same)
        {
          far = c;
          far[square.axis] += square.leaf.size;
        }

      std::array<LatticePoint<3>, 8> ring;
      unsigned int                   n = 0;
      for (unsigned int q = 0; q < 4; ++q)
        {
          const unsigned int    before = (q + 3) % 4;
          const LatticePoint<3> e1     = midpoint<3>(corner[before], corner[q]);
          const LatticePoint<3> e2     = midpoint<3>(corner[q], corner[(q + 1) % 4]);
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

    template <>
    void
    FaceFiller<3>::fill_square(const Leaf<3>     &leaf,
                               const unsigned int axis,
                               const bool         upper,
                               const Neighbour    other)
    {
      const Square square(leaf, axis, upper);
      if (other == Neighbour::coarser)
        fill_halves(square);
      else
        fill_ring(square, other);
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

  template struct Lattice<2>;
  template struct Lattice<3>;
  template Lattice<2>
  make_lattice(const Octree<2> &);
  template Lattice<3>
  make_lattice(const Octree<3> &);
} // namespace treacle
