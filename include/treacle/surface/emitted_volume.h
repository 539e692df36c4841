// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_emitted_volume_h
#define treacle_surface_emitted_volume_h

#include <treacle/surface/emitter_filling.h>

#include <unordered_map>

namespace treacle
{
  /// What an emitter adds in simplices. In a step it may be much thinner than a leaf, which functions that are linear between nodes show
  /// 20 to 50 % too thick or too thin at edges and corners of the emitter: so a simplex is halved where they matter, along each edge about once,
  /// and as long as that changes its part, until edges are an eighth as long. What is in the middle of two vertices, which several parts and
  /// simplices share, is found once.
  template <int dim>
  class EmittedVolume
  {
  public:
    /// Refers to it.
    explicit EmittedVolume(const EmitterFilling<dim> &filling)
      : filling(filling)
    {}

    struct Vertex
    {
      Point<dim>                        x;
      double                            old; ///< phi
      double                            psi; ///< distance to solids
      Tensor<1, dim>                    v;   ///< of the liquid (m/s)
      typename EmitterFilling<dim>::Phi phi;
    };
    using Vertices = std::array<unsigned int, dim + 1>; ///< their indices

    /// The next one, with the values there. Those of the simplices come first.
    const Vertex &
    add(const Point<dim> &x, const double old, const double psi, const Tensor<1, dim> &v)
    {
      vertices.push_back({x, old, psi, v, filling.phi(x, old, v)});
      return vertices.back();
    }

    const Vertex &
    operator[](const unsigned int i) const
    {
      return vertices[i];
    }

    /// The index of what is in the middle of two.
    unsigned int
    middle(const unsigned int i, const unsigned int j);

    /// (m^dim)
    double
    operator()(const Vertices &simplex);

  private:
    const EmitterFilling<dim>                      &filling;
    std::vector<Vertex>                             vertices;
    std::unordered_map<std::uint64_t, unsigned int> middles; ///< by two indices
  };
} // namespace treacle

#endif
