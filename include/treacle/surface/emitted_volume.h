// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_surface_emitted_volume_h
#define treacle_surface_emitted_volume_h

#include <treacle/surface/emitter_filling.h>

namespace treacle
{
  /// What an emitter adds in a simplex. In a step it may be much thinner than a leaf, which functions that are linear between nodes show
  /// 20 to 50 % too thick or too thin at edges and corners of the emitter: so the simplex is halved where they matter, along each edge about once,
  /// and as long as that changes its part, until edges are an eighth as long.
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
    using Vertices = std::array<Vertex, dim + 1>;

    Vertex
    vertex(const Point<dim> &x, const double old, const double psi, const Tensor<1, dim> &v) const
    {
      return {x, old, psi, v, filling.phi(x, old, v)};
    }

    /// (m^dim)
    double
    operator()(const Vertices &v) const;

  private:
    const EmitterFilling<dim> &filling;
  };
} // namespace treacle

#endif
