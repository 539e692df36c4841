// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) the Treacle authors

#ifndef treacle_viscosity_hybrid_h
#define treacle_viscosity_hybrid_h

#include <treacle/viscosity/reactions.h>

namespace treacle
{
  /// Viscosity at the nodes, which drags the faces along: the velocity u of the faces and
  /// v of the nodes make
  ///
  ///   1/2 |u - u*|^2_M + 1/2 v·K v + 1/2 |u - P v|^2_N,   K = -step D, N = drag nu step / h^2 M,
  ///
  /// least. What P v cannot follow decays at the rate drag nu / h^2, smooth motion
  /// as K says, to second order in h; no force acts on a rigid motion, and none is created. Solved for together with the pressure, N is
  /// up to 31 times as large at faces between a cell with pressure and one without, at the free surface, in stiff liquid: the pressure of what
  /// is pulled or pressed along it ends there, as if it fell to zero, and would drive liquid out through what the nodes do not hold of the face.
  /// With the share s = N / (M + N) it is
  ///
  ///   (K + P^T s M P) v = P^T s M u*,   u = (1 - s) u* + s P v.
  template <int dim>
  class Hybrid
  {
  public:
    /// On which faces the drag acts in the system for v: on all, or, solved for together with
    /// the pressure, on those that it acts on, on free ones, and on all of liquid without any pressure cell.
    enum class Faces
    {
      all,
      under_pressure
    };

    Hybrid(const NodeSystem<dim>                     &system,
           const typename NodeSystem<dim>::Stiffness &stiffness,
           const double                               step,
           const Faces                                faces);

    /// P^T s M u*, and what prescribed values contribute. Faces that take no part pull v,
    /// if nothing else does, to where it is.
    Vector
    right_hand_side(const Vector &u, const NodeVector<dim> &v) const;

    /// state.u = (1 - s) state.u + s P v with state.v. What holds the prescribed nodes, for
    /// K of this stiffness, is added to the reactions, if there are such.
    void
    drag_faces(State<dim>                                &state,
               const typename NodeSystem<dim>::Stiffness &stiffness,
               Reactions<dim>                            *reactions) const;

    const NodeSystem<dim>               &system;
    std::vector<double>                  share; ///< s of each face, owned or ghost
    /// 1 - s, of which nothing is left where viscosity spreads over 1e8 leaves in a step, unless it is found by itself.
    std::vector<double>                  rest;
    typename NodeSystem<dim>::Assembled  stiff; ///< K + P^T s M P

  private:
    /// Of owned faces.
    std::vector<unsigned char>
    find_idle(const Faces faces) const;

    const std::vector<unsigned char> is_idle; ///< owned faces that take no part
    std::vector<double>              weight;  ///< s M of each face in the system
  };
} // namespace treacle

#endif
